// Which maps an export has, and what becomes of their pixels.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "pelagic/tools/files/image_compression.hpp"
#include "pelagic/tools/files/sample.hpp"
#include "pelagic/tools/maps/axes.hpp"
#include "pelagic/tools/maps/map_kind.hpp"
#include "pelagic/tools/maps/name_pattern.hpp"
#include "pelagic/tools/text/named_values.hpp"

namespace pelagic::tools {

/// What files an image becomes.
enum class ImageFormat {
    exr_and_png,  ///< floats as EXR, bytes and words as PNG
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

/// How finely normal and foam are stored.
enum class BitDepth { bits_8, bits_16, floats };
inline constexpr NamedValues<BitDepth, 3> bit_depth_names = {
    {{BitDepth::bits_8, "8"}, {BitDepth::bits_16, "16"}, {BitDepth::floats, "float"}}};

/// Where a normal map's green grows to in the image.
enum class NormalY {
    up,    ///< OpenGL's way
    down,  ///< DirectX's
};
inline constexpr NamedValues<NormalY, 2> normal_y_names = {{{NormalY::up, "up"}, {NormalY::down, "down"}}};

/// At which edge of the image the cascade's row 0 is, the one of z = 0.
enum class FirstRow { top, bottom };
inline constexpr NamedValues<FirstRow, 2> first_row_names = {{{FirstRow::top, "top"}, {FirstRow::bottom, "bottom"}}};

/// What is in one file.
enum class Pack {
    files,   ///< a map of a cascade
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
    bool half = false;                      ///< floats as 16 bits
    BitDepth bit_depth = BitDepth::bits_8;  ///< of normal and foam
    NormalY normal_y = NormalY::up;
    UpAxis up_axis = UpAxis::y;
    LengthUnit unit = LengthUnit::metre;  ///< of displacement, and of velocity a second
    FirstRow rows = FirstRow::top;
    ImageFormat format = ImageFormat::exr_and_png;
    Compression compression = Compression::zip;  ///< of EXR, TIFF and KTX2
    Pack pack = Pack::files;
    bool tiled = false;                ///< EXR in tiles, with the levels within
    std::optional<NamePattern> names;  ///< none: "displacement_0007.exr"

    bool has(MapKind map) const { return std::find(maps.begin(), maps.end(), map) != maps.end(); }
    /// The map is stored as EXR.
    bool is_exr(MapKind map) const {
        return pack != Pack::files || (format == ImageFormat::exr_and_png && is_floating(sample_of(map)));
    }
    /// In what type the map's values are stored.
    Sample sample_of(MapKind map) const {
        if (map == MapKind::gradient || (has_bit_depth(map) && bit_depth == BitDepth::bits_8)) return Sample::uint8;
        if (has_bit_depth(map) && bit_depth == BitDepth::bits_16) return Sample::uint16;
        return half || format == ImageFormat::ktx2 ? Sample::half : Sample::float32;
    }
};

}  // namespace pelagic::tools
