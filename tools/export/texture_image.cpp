#include "pelagic/tools/export/texture_image.hpp"

#include <cassert>
#include <cstring>

#include "pelagic/tools/encode/dds_file.hpp"
#include "pelagic/tools/encode/ktx2_file.hpp"

namespace pelagic::tools {
namespace {

/// Returns the bytes of the value 1 in the sample type, in the machine's byte order.
std::vector<std::byte> one(Sample sample) {
    std::vector<std::byte> bytes(bytes_of(sample), std::byte{0xFF});
    if (sample == Sample::half) bytes = {std::byte{0x00}, std::byte{0x3C}};
    if (sample == Sample::float32) bytes = {std::byte{0x00}, std::byte{0x00}, std::byte{0x80}, std::byte{0x3F}};
    return bytes;
}

TextureImage with_fourth_channel(const TextureImage& image) {
    TextureImage filled{image.width, image.height, 4, image.sample, {}};
    const std::size_t sample = bytes_of(image.sample), texels = image.pixels.size() / (3 * sample);
    const std::vector<std::byte> fourth = one(image.sample);
    filled.pixels.resize(texels * 4 * sample);
    for (std::size_t texel = 0; texel < texels; ++texel) {
        std::byte* const to = &filled.pixels[texel * 4 * sample];
        std::memcpy(to, &image.pixels[texel * 3 * sample], 3 * sample);
        std::memcpy(to + 3 * sample, fourth.data(), sample);
    }
    return filled;
}

}  // namespace

std::vector<unsigned char> encode_texture(const std::vector<TextureImage>& levels, const MapOptions& options) {
    assert(is_texture(options.format) && !levels.empty());
    std::vector<TextureImage> filled;
    Texture texture{.width = levels[0].width,
                    .height = levels[0].height,
                    .channels = levels[0].channels == 3 ? 4 : levels[0].channels,
                    .sample = levels[0].sample,
                    .levels = {}};
    filled.reserve(levels.size());
    for (const TextureImage& level : levels) {
        if (level.channels == 3) filled.push_back(with_fourth_channel(level));
        const std::vector<std::byte>& pixels = level.channels == 3 ? filled.back().pixels : level.pixels;
        texture.levels.emplace_back(reinterpret_cast<const unsigned char*>(pixels.data()), pixels.size());
    }
    if (options.format == ImageFormat::dds) return dds_file(texture);
    return ktx2_file(texture,
                     options.compression == Compression::zstd ? Supercompression::zstd : Supercompression::none);
}

}  // namespace pelagic::tools
