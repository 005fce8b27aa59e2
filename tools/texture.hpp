// A texture as graphics interfaces take it: pixels of one format and their levels, whatever container holds them.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace pelagic::tools {

/// What one channel of a texel is.
enum class TexelSample {
    unorm8,   ///< a byte b, read as b / 255
    unorm16,  ///< a 16-bit word w, read as w / 65535
    half,     ///< IEEE 754 binary16
    float32,  ///< IEEE 754 binary32
};

/// Bytes of one channel.
int size_of(TexelSample sample);

struct Texture {
    int width, height;
    int channels;  ///< 1, 2 or 4: graphics interfaces need not read textures of three
    TexelSample sample;
    /// Rows from the top, channels interleaved, no gaps, numbers with the lowest byte first. Level p is width >> p wide and
    /// height >> p high, at least 1, and starts with the largest.
    std::vector<std::span<const unsigned char>> levels;
};

/// Bytes that level p has.
std::size_t bytes_of_level(const Texture& texture, int level);

/// Empty if a container can hold it, else what is wrong with it: "level 1 has 12 bytes, needs 16".
std::string check(const Texture& texture);

}  // namespace pelagic::tools
