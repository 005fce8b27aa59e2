// In what type an image keeps its values.
#pragma once

#include <cstddef>

namespace pelagic::tools {

enum class Sample {
    uint8,   ///< a byte b stands for b / 255
    uint16,  ///< a word w stands for w / 65535
    half,    ///< IEEE 754 binary16
    float32,
};

constexpr std::size_t bytes_of(Sample sample) {
    switch (sample) {
        case Sample::uint8: return 1;
        case Sample::uint16:
        case Sample::half: return 2;
        case Sample::float32: return 4;
    }
    return 0;
}

/// Values are themselves, and no parts of 255 or 65535.
constexpr bool is_floating(Sample sample) { return sample == Sample::half || sample == Sample::float32; }

}  // namespace pelagic::tools
