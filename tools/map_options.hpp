// Which maps an export has, and what becomes of their pixels.
#pragma once

#include <algorithm>
#include <vector>

#include "pelagic/tools/map_image.hpp"
#include "pelagic/tools/map_kind.hpp"

namespace pelagic::tools {

/// What files an image becomes.
enum class ImageFormat {
    exr_and_png,  ///< floats as EXR, bytes as PNG
    tiff,
};

struct MapOptions {
    std::vector<MapKind> maps = {MapKind::displacement, MapKind::gradient};  ///< each once, in the order of all_maps
    bool mips = false;
    bool half = false;  ///< floats as 16 bits
    ImageFormat format = ImageFormat::exr_and_png;

    bool has(MapKind map) const { return std::find(maps.begin(), maps.end(), map) != maps.end(); }
    /// In what type the map's values are stored.
    Sample sample_of(MapKind map) const {
        if (map != MapKind::displacement) return Sample::uint8;
        return half ? Sample::half : Sample::float32;
    }
};

}  // namespace pelagic::tools
