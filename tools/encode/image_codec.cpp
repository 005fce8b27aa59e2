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

std::vector<unsigned char> encode_light(std::span<const float> rgb, std::span<const std::string> names,
                                        std::span<const float> values, int width, int height) {
    ImageDescription image{.extension = "exr",
                           .width = width,
                           .height = height,
                           .channels = static_cast<int>(3 + names.size()),
                           .sample = Sample::float32,
                           .colour_space = "Linear",
                           .compression = "zip",
                           .channel_names = {"R", "G", "B"}};
    image.channel_names.insert(image.channel_names.end(), names.begin(), names.end());
    std::vector<float> pixels;
    pixels.reserve(rgb.size() + values.size());
    for (std::size_t i = 0; i < rgb.size() / 3; ++i) {
        const auto colour = rgb.subspan(3 * i, 3), others = values.subspan(names.size() * i, names.size());
        pixels.insert(pixels.end(), colour.begin(), colour.end());
        pixels.insert(pixels.end(), others.begin(), others.end());
    }
    return image_codec().encode(image, pixels.data());
}

}  // namespace pelagic::tools
