// Which maps an export has, and what becomes of their pixels.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "pelagic/tools/image_compression.hpp"
#include "pelagic/tools/map_image.hpp"
#include "pelagic/tools/map_kind.hpp"
#include "pelagic/tools/name_pattern.hpp"

namespace pelagic::tools {

/// What files an image becomes.
enum class ImageFormat {
    exr_and_png,  ///< floats as EXR, bytes as PNG
    tiff,
    ktx2,  ///< a map's levels in one file; floats are halves
    dds,   ///< likewise, for Direct3D
};

inline constexpr std::array all_formats = {ImageFormat::exr_and_png, ImageFormat::tiff, ImageFormat::ktx2,
                                           ImageFormat::dds};

/// As --format and records have it.
constexpr const char* name_of(ImageFormat format) {
    switch (format) {
        case ImageFormat::exr_and_png: return "exr";
        case ImageFormat::tiff: return "tif";
        case ImageFormat::ktx2: return "ktx2";
        case ImageFormat::dds: return "dds";
    }
    return "";
}

/// What is in one file.
enum class Pack {
    files,   ///< a map of a tile
    layers,  ///< all of a frame, as layers of one EXR image
    parts,   ///< all of a frame, as parts of one EXR file
};
inline constexpr std::array all_packs = {Pack::files, Pack::layers, Pack::parts};

/// As --pack and records have it.
constexpr const char* name_of(Pack pack) {
    switch (pack) {
        case Pack::files: return "files";
        case Pack::layers: return "layers";
        case Pack::parts: return "parts";
    }
    return "";
}

/// Its files are what graphics interfaces sample, with all levels inside.
constexpr bool is_texture(ImageFormat format) { return format == ImageFormat::ktx2 || format == ImageFormat::dds; }

struct MapOptions {
    std::vector<MapKind> maps = {MapKind::displacement, MapKind::gradient};  ///< each once, in the order of all_maps
    bool mips = false;
    bool half = false;  ///< floats as 16 bits
    ImageFormat format = ImageFormat::exr_and_png;
    Compression compression = Compression::zip;  ///< of EXR, TIFF and KTX2
    Pack pack = Pack::files;
    bool tiled = false;                ///< EXR in tiles, with the levels within
    std::optional<NamePattern> names;  ///< none: "displacement_0007.exr"

    bool has(MapKind map) const { return std::find(maps.begin(), maps.end(), map) != maps.end(); }
    /// The map is stored as EXR.
    bool is_exr(MapKind map) const {
        return pack != Pack::files || (format == ImageFormat::exr_and_png && sample_of(map) != Sample::uint8);
    }
    /// In what type the map's values are stored.
    Sample sample_of(MapKind map) const {
        if (map != MapKind::displacement) return Sample::uint8;
        return half || format == ImageFormat::ktx2 ? Sample::half : Sample::float32;
    }
};

}  // namespace pelagic::tools
