// Values of maps before quantisation. They are floats computed with + - * / and square roots only,
// and bit-identical on every machine.
#pragma once

#include <vector>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/tools/maps/map_options.hpp"

namespace pelagic::tools {

/// A square of texels from row 0 of the cascade on, independent of the image's first row.
struct MapValues {
    int side = 0;
    int channels = 0;
    std::vector<float> values;  ///< interleaved, side^2 * channels
};

/// Returns level 0 of any map but gradient, which the cascade stores as bytes. Vectors are along
/// the options' axes and in their unit; normals are along the cascade's own axes.
/// \pre the cascade has the map's views (asserted)
MapValues map_values(const Cascade& cascade, MapKind map, const MapOptions& options);

/// Returns the next mip level, the means of 2 x 2 texels.
MapValues halved(const MapValues& finer);

/// Returns unit vectors; zero vectors become vertical.
MapValues normalised(MapValues normals);

}  // namespace pelagic::tools
