// A texture for graphics APIs: pixels of one format and their mip levels, independent of the file
// format.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "pelagic/tools/files/sample.hpp"

namespace pelagic::tools {

struct Texture {
    int width, height;
    int channels;  ///< 1, 2 or 4: graphics APIs need not support three channels
    Sample sample;
    /// Top row first, channels interleaved, without padding, least significant byte first. Level p
    /// has max(1, width >> p) x max(1, height >> p) texels. The largest level comes first.
    std::vector<std::span<const unsigned char>> levels;
};

/// Returns the bytes of a texel with all channels.
std::size_t bytes_of_texel(const Texture& texture);

/// Returns the bytes of a level.
std::size_t bytes_of_level(const Texture& texture, int level);

/// Returns an empty text if a file can hold the texture, else the error: "level 1 has 12 bytes,
/// needs 16".
std::string check(const Texture& texture);

}  // namespace pelagic::tools
