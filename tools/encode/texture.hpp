// A texture as graphics interfaces take it: pixels of one format and their levels, whatever container holds them.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "pelagic/tools/files/sample.hpp"

namespace pelagic::tools {

struct Texture {
    int width, height;
    int channels;  ///< 1, 2 or 4: graphics interfaces need not read textures of three
    Sample sample;
    /// Rows from the top, channels interleaved, no gaps, numbers with the lowest byte first. Level p is width >> p wide and
    /// height >> p high, at least 1, and starts with the largest.
    std::vector<std::span<const unsigned char>> levels;
};

/// Of all channels.
std::size_t bytes_of_texel(const Texture& texture);

/// Bytes that level p has.
std::size_t bytes_of_level(const Texture& texture, int level);

/// Empty if a container can hold it, else what is wrong with it: "level 1 has 12 bytes, needs 16".
std::string check(const Texture& texture);

}  // namespace pelagic::tools
