#include "pelagic/tools/image_writer.hpp"

#include "pelagic/tools/image_codec.hpp"

namespace pelagic::tools {
namespace {

using Sample = ImageDescription::Sample;

/// `channels` interleaved values a texel, from the tile's float planes.
std::vector<float> interleaved_floats(const Tile& tile) {
    std::vector<float> pixels;
    pixels.reserve(3 * static_cast<std::size_t>(tile.resolution()) * tile.resolution());
    for (int j = 0; j < tile.resolution(); ++j) {
        for (int i = 0; i < tile.resolution(); ++i)
            pixels.insert(pixels.end(), {tile.dx.at(i, j), tile.height.at(i, j), tile.dz.at(i, j)});
    }
    return pixels;
}

/// The first three of the tile's four halves a texel: the fourth is foam.
std::vector<std::uint16_t> three_halves(const Tile& tile) {
    std::vector<std::uint16_t> pixels;
    pixels.reserve(tile.displacement_rgba16f.size() / 4 * 3);
    for (std::size_t texel = 0; texel < tile.displacement_rgba16f.size(); texel += 4) {
        const std::uint16_t* halves = tile.displacement_rgba16f.data() + texel;
        pixels.insert(pixels.end(), halves, halves + 3);
    }
    return pixels;
}

/// Of one channel, stored as it is.
ImageDescription bytes_of_level(const Tile& tile, int level, ImageFormat format) {
    const int side = tile.resolution() >> level;
    const bool is_tiff = format == ImageFormat::tiff;
    // zlib's default for PNG, 6, takes four times as long for files 6 % smaller (512 x 512, jonswap).
    return {.extension = gradient_extension(format),
            .width = side,
            .height = side,
            .channels = 1,
            .sample = Sample::uint8,
            .colour_space = "Raw",
            .compression = is_tiff ? "zip" : nullptr,
            .png_level = is_tiff ? 0 : 2};
}

}  // namespace

std::vector<unsigned char> encode_displacement(const Tile& tile, ImageFormat format, bool half) {
    const int n = tile.resolution();
    const ImageDescription image{.extension = displacement_extension(format),
                                 .width = n,
                                 .height = n,
                                 .channels = 3,
                                 .sample = half ? Sample::half : Sample::float32,
                                 .colour_space = "Linear",
                                 .compression = "zip"};
    return half ? image_codec().encode(image, three_halves(tile).data())
                : image_codec().encode(image, interleaved_floats(tile).data());
}

std::vector<unsigned char> encode_gradient(const Tile& tile, int level, ImageFormat format) {
    ImageDescription image = bytes_of_level(tile, level, format);
    image.channels = 4;
    image.has_unassociated_alpha = true;
    // A texel's lowest byte is its red one, in memory the first.
    return image_codec().encode(image, tile.gradient_level(level).data());
}

std::vector<unsigned char> encode_foam(const Tile& tile, int level, ImageFormat format) {
    return image_codec().encode(bytes_of_level(tile, level, format), tile.level_of(tile.foam_r8, level).data());
}

std::vector<unsigned char> encode_picture(std::span<const std::uint8_t> rgba, int width, int height) {
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

const char* displacement_extension(ImageFormat format) { return format == ImageFormat::tiff ? "tif" : "exr"; }
const char* gradient_extension(ImageFormat format) { return format == ImageFormat::tiff ? "tif" : "png"; }

}  // namespace pelagic::tools
