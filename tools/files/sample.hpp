// Number types of pixel values.
#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "pelagic/message/enum_names.hpp"

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

enum class Compression {
    zip,   ///< deflate; in an EXR file, blocks of 16 rows
    zips,  ///< deflate of single rows; EXR only
    piz,   ///< wavelets; EXR only
    dwaa,  ///< cosine transform; EXR only, and the only lossy one
    lzw,   ///< TIFF only
    zstd,  ///< KTX2 only
    none,
};

}  // namespace pelagic::tools
// Names in options and in records.
namespace pelagic {

template <>
struct EnumNames<tools::Compression> {
    static constexpr std::array<std::string_view, 7> all = {"zip", "zips", "piz", "dwaa", "lzw", "zstd", "none"};
};

}  // namespace pelagic
