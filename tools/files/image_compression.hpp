// How the pixels in an EXR, TIFF or KTX2 file are packed.
#pragma once

#include <array>

namespace pelagic::tools {

enum class Compression {
    zip,   ///< deflate; in an EXR of 16 rows together
    zips,  ///< deflate of single rows, EXR alone
    piz,   ///< wavelets, EXR alone
    dwaa,  ///< cosines, EXR alone; the only one that changes values
    lzw,   ///< TIFF alone
    zstd,  ///< KTX2 alone
    none,
};

inline constexpr std::array exr_compressions = {Compression::zip, Compression::zips, Compression::piz,
                                                Compression::dwaa, Compression::none};
inline constexpr std::array tiff_compressions = {Compression::zip, Compression::lzw, Compression::none};
inline constexpr std::array ktx2_compressions = {Compression::zstd, Compression::none};
inline constexpr std::array dds_compressions = {Compression::none};

/// As --compression, records and OpenImageIO have it.
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
