// Levels of a map as a texture file.
#pragma once

#include <vector>

#include "pelagic/tools/maps/map_options.hpp"

namespace pelagic::tools {

/// Some pixels of a map, or of many side by side: interleaved, rows from the top, no gaps.
struct TextureImage {
    int width = 0, height = 0, channels = 0;
    Sample sample = Sample::uint8;
    std::vector<std::byte> pixels;
};

/// KTX2 or DDS. Three channels get a fourth of 1, for graphics interfaces need not read textures of three. Throws FileError for
/// Zstandard if Pelagic was built without libzstd.
/// \param levels  the largest first, each half as wide and high as the one before
/// \pre the options' format is a texture's (asserted)
std::vector<unsigned char> encode_texture(const std::vector<TextureImage>& levels, const MapOptions& options);

}  // namespace pelagic::tools
