// Values of maps before quantisation. They are floats computed with + - * / and square roots only,
// and bit-identical on every machine.
#pragma once

#include <vector>

#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/maps/map_options.hpp"

namespace pelagic::tools {

/// A square of texels from row 0 of the cascade on, independent of the image's first row.
struct MapValues {
    int side = 0;
    int channels = 0;
    std::vector<float> values;  ///< interleaved, side^2 * channels
};

/// Returns level 0 of any map but gradient, which the cascade stores as bytes. Vectors are along
/// the options' axes and in their unit; normals are along the cascade's own axes. Foam is that of
/// all cascades.
/// \param cascade  index in the frame
/// \pre the cascade has the map's views (asserted)
MapValues map_values(const Frame& frame, int cascade, MapKind map, const MapOptions& options);

/// Returns the foam of all cascades on a square of side^2 points, metres apart along x and z. The
/// first point is at the fraction `first` of this distance. \pre the frame has foam (asserted)
MapValues foam_values(const Frame& frame, int side, double spacing_m, double first);

/// Returns the next mip level, the means of 2 x 2 texels.
MapValues halved(const MapValues& finer);

/// Returns unit vectors; zero vectors become vertical.
MapValues normalised(MapValues normals);

}  // namespace pelagic::tools
