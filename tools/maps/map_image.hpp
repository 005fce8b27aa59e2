// The pixels of one map of one cascade, for any container: interleaved, rows from the top.
#pragma once

#include <cstddef>
#include <vector>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/dynamic_waves_view.hpp"
#include "pelagic/tools/maps/map_options.hpp"

namespace pelagic::tools {

struct MapImage {
    int side = 0;
    int channels = 0;
    Sample sample = Sample::float32;
    std::vector<std::byte> pixels;  ///< side^2 channels values, no gaps, in this machine's byte order
};

/// One level of a map: pixels as channels_as_json() says, in rows as layout_as_json() says (pixel_meaning.hpp). Levels of any map
/// are means of 2 x 2 texels; normals are unit vectors at every level, which is what shaders expect.
/// \pre the cascade has the map's views (asserted)
MapImage map_image(const Cascade& cascade, MapKind map, int level, const MapOptions& options);

/// So many levels of a map, the largest first; cheaper than one after the other.
std::vector<MapImage> map_levels(const Cascade& cascade, MapKind map, int first_level, int levels,
                                 const MapOptions& options);

/// Dynamic waves: heights, vertical velocity, foam; rows and columns from the grid's lowest texel on, along z and x.
MapImage dynamic_waves_map_image(const DynamicWavesView& water, const MapOptions& options);

/// Whether any image of this process holds +-65504, the largest half, for a value beyond that. Any thread.
bool clamped_halves();

}  // namespace pelagic::tools
