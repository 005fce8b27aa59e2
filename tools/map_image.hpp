// The pixels of one map of one tile, for any container: interleaved, rows from the top. Image row j is texel row j (z), column i
// is x.
#pragma once

#include <cstddef>
#include <vector>

#include "pelagic/sim/tile.hpp"
#include "pelagic/tools/map_kind.hpp"
#include "pelagic/tools/sample.hpp"

namespace pelagic::tools {

struct MapImage {
    int side = 0;
    int channels = 0;
    Sample sample = Sample::float32;
    std::vector<std::byte> pixels;  ///< side^2 channels values, no gaps
};

/// How many values a texel of the map has.
int channels_of(MapKind map);

/// One level of a map, as the tile has it.
/// \pre the tile has the map's views, and displacement has level 0 alone (asserted)
MapImage map_image(const Tile& tile, MapKind map, int level, Sample sample);

/// So many levels of a map, the largest first; of displacement, whose tile has no chain, the means of 2 x 2 texels.
std::vector<MapImage> map_levels(const Tile& tile, MapKind map, int levels, Sample sample);

}  // namespace pelagic::tools
