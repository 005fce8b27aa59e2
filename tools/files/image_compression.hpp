// Compression of the pixels in EXR, TIFF and KTX2 files.
#pragma once

#include <array>
#include <string_view>

#include "pelagic/message/enum_names.hpp"

namespace pelagic::tools {

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
