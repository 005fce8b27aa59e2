#include "pelagic/tools/encode/image_codec.hpp"

namespace pelagic::tools {

std::vector<unsigned char> encode_png(std::span<const std::uint8_t> rgba, int width, int height) {
    std::vector<std::uint8_t> rgb;
    rgb.reserve(rgba.size() / 4 * 3);
    for (std::size_t i = 0; i < rgba.size(); i += 4) rgb.insert(rgb.end(), {rgba[i], rgba[i + 1], rgba[i + 2]});
    const ImageDescription image{.extension = "png",
                                 .width = width,
                                 .height = height,
                                 .channels = 3,
                                 .sample = Sample::uint8,
                                 .colour_space = "sRGB",
                                 .compression = nullptr};
    return image_codec().encode(image, rgb.data());
}

std::vector<unsigned char> encode_light(std::span<const float> rgb, int width, int height) {
    const ImageDescription image{.extension = "exr",
                                 .width = width,
                                 .height = height,
                                 .channels = 3,
                                 .sample = Sample::float32,
                                 .colour_space = "Linear",
                                 .compression = "zip"};
    return image_codec().encode(image, rgb.data());
}

}  // namespace pelagic::tools
