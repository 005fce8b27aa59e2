// Compression of the pixels in EXR, TIFF and KTX2 files.
#pragma once

#include <array>

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

inline constexpr std::array exr_compressions = {Compression::zip, Compression::zips, Compression::piz,
                                                Compression::dwaa, Compression::none};
inline constexpr std::array tiff_compressions = {Compression::zip, Compression::lzw, Compression::none};
inline constexpr std::array ktx2_compressions = {Compression::zstd, Compression::none};
inline constexpr std::array dds_compressions = {Compression::none};

/// Returns the name that --compression, records and OpenImageIO use.
constexpr const char* name_of(Compression compression) {
    switch (compression) {
        case Compression::zip: return "zip";
        case Compression::zips: return "zips";
        case Compression::piz: return "piz";
        case Compression::dwaa: return "dwaa";
        case Compression::lzw: return "lzw";
        case Compression::zstd: return "zstd";
        case Compression::none: return "none";
    }
    return "";
}

}  // namespace pelagic::tools
