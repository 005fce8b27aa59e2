// Number types of pixel values.
#pragma once

#include <cstddef>

namespace pelagic::tools {

enum class Sample {
    uint8,   ///< a byte b represents b / 255
    uint16,  ///< a 16-bit word w represents w / 65535
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

/// Returns true if a sample stores the value itself rather than a fraction of 255 or 65535.
constexpr bool is_floating(Sample sample) { return sample == Sample::half || sample == Sample::float32; }

}  // namespace pelagic::tools
