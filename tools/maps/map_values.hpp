// What the pixels of a map stand for, before they are rounded to the type that stores them. The same bits everywhere: floats, and
// only + - * / and square roots.
#pragma once

#include <vector>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/tools/maps/map_options.hpp"

namespace pelagic::tools {

/// A square of texels from row 0 of the cascade on, whatever the image's first row is.
struct MapValues {
    int side = 0;
    int channels = 0;
    std::vector<float> values;  ///< interleaved, side^2 channels
};

/// Level 0 of any map but gradient, whose bytes the cascade has. Along the options' axes and in their unit; normals along the cascade's
/// own. \pre the cascade has the map's views (asserted)
MapValues map_values(const Cascade& cascade, MapKind map, const MapOptions& options);

/// The means of 2 x 2 texels.
MapValues halved(const MapValues& finer);

/// Vectors of length 1, straight up where there is none.
MapValues normalised(MapValues normals);

}  // namespace pelagic::tools
