// Encoding of the mip levels of a map as a texture file.
#pragma once

#include <vector>

#include "pelagic/tools/maps/map_options.hpp"

namespace pelagic::tools {

/// Pixels of a map, or of many side by side: interleaved, top row first, without padding.
struct TextureImage {
    int width = 0, height = 0, channels = 0;
    Sample sample = Sample::uint8;
    std::vector<std::byte> pixels;
};

/// Encodes a KTX2 or DDS file. Adds a fourth channel of 1 to three channels, since graphics APIs
/// need not support textures of three. Throws FileError for Zstandard if Pelagic was built without
/// libzstd.
/// \param levels  the largest first; each has half the width and height of the previous one
/// \pre options.format is a texture format (asserted)
std::vector<unsigned char> encode_texture(const std::vector<TextureImage>& levels, const MapOptions& options);

}  // namespace pelagic::tools
