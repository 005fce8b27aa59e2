// Options of exported maps: kinds, pixel formats and file formats.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <vector>

#include "pelagic/tools/files/sample.hpp"
#include "pelagic/tools/maps/axes.hpp"
#include "pelagic/tools/maps/map_kind.hpp"
#include "pelagic/tools/maps/name_pattern.hpp"

namespace pelagic::tools {

/// File format of images.
enum class ImageFormat {
    exr_and_png,  ///< floats as EXR, 8-bit and 16-bit integers as PNG
    tiff,
    ktx2,  ///< all levels of a map in one file; floats are stored as halves
    dds,   ///< all levels of a map in one file, for Direct3D
};

/// Sample type of normal and foam maps.
enum class BitDepth { bits_8, bits_16, floats };

/// Direction of increasing green of a normal map in the image.
enum class NormalY {
    up,    ///< OpenGL's convention
    down,  ///< DirectX's convention
};

/// Edge of the image at which the cascade's row 0 (z = 0) is.
enum class FirstRow { top, bottom };

/// Content of one file.
enum class Pack {
    files,   ///< one map of a cascade
    layers,  ///< all maps of a frame, as layers of one EXR image
    parts,   ///< all maps of a frame, as parts of one multi-part EXR file
};

/// Returns true for GPU texture formats, whose files hold all levels.
constexpr bool is_texture(ImageFormat format) { return format == ImageFormat::ktx2 || format == ImageFormat::dds; }

/// The square of the sea, from the origin along +x and +z, whose foam is in one image.
struct FoamPatch {
    double side_m = 200;
    int pixels = 1024;  ///< along a side

    double pixel_m() const { return side_m / pixels; }
};

struct MapOptions {
    /// Each map at most once, in the order of all_maps.
    std::vector<MapKind> maps = {MapKind::displacement, MapKind::gradient};
    bool mips = false;
    bool half = false;                      ///< store floats as 16 bits
    BitDepth bit_depth = BitDepth::bits_8;  ///< of normal and foam maps
    NormalY normal_y = NormalY::up;
    UpAxis up_axis = UpAxis::y;
    LengthUnit unit = LengthUnit::metre;  ///< unit of displacement, and per second of velocity
    FirstRow rows = FirstRow::top;
    ImageFormat format = ImageFormat::exr_and_png;
    Compression compression = Compression::zip;  ///< of EXR, TIFF and KTX2 files
    Pack pack = Pack::files;
    bool tiled = false;                ///< tiled EXR files that contain the levels
    std::optional<FoamPatch> foam_patch;  ///< replaces the foam maps of several cascades
    std::optional<NamePattern> names;  ///< unset: "displacement_0007.exr"

    bool has(MapKind map) const { return std::find(maps.begin(), maps.end(), map) != maps.end(); }
    /// Returns true if the map is stored as EXR.
    bool is_exr(MapKind map) const {
        return pack != Pack::files || (format == ImageFormat::exr_and_png && is_floating(sample_of(map)));
    }
    /// Returns the type of the map's stored values.
    Sample sample_of(MapKind map) const {
        if (map == MapKind::gradient || (has_bit_depth(map) && bit_depth == BitDepth::bits_8)) return Sample::uint8;
        if (has_bit_depth(map) && bit_depth == BitDepth::bits_16) return Sample::uint16;
        return half || format == ImageFormat::ktx2 ? Sample::half : Sample::float32;
    }
};

}  // namespace pelagic::tools

// Names in options and in records.
namespace pelagic {

template <>
struct EnumNames<tools::ImageFormat> {
    static constexpr std::array<std::string_view, 4> all = {"exr", "tif", "ktx2", "dds"};
};

template <>
struct EnumNames<tools::BitDepth> {
    static constexpr std::array<std::string_view, 3> all = {"8", "16", "float"};
};

template <>
struct EnumNames<tools::NormalY> {
    static constexpr std::array<std::string_view, 2> all = {"up", "down"};
};

template <>
struct EnumNames<tools::FirstRow> {
    static constexpr std::array<std::string_view, 2> all = {"top", "bottom"};
};

template <>
struct EnumNames<tools::Pack> {
    static constexpr std::array<std::string_view, 3> all = {"files", "layers", "parts"};
};

}  // namespace pelagic
