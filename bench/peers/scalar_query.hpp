// Surface queries one point at a time, in plain code: the method of sim/surface_query where the
// surface does not fold, bit-identical to it (tests/peers_test.cpp); and the lower bound of the
// cost, a bilinear sample that ignores the displacement.
#pragma once

#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic::peers {

struct ScalarSample {
    float height_m, normal_x, normal_y, normal_z, error_m;
};

/// \pre the surface does not fold at the point; the point is finite
ScalarSample scalar_query(const Frame& frame, double x_m, double z_m,
                          double tolerance_m = SurfaceQuery::default_tolerance_m);

/// Returns the height at the reference position instead of the displaced position.
float scalar_lookup(const Frame& frame, double x_m, double z_m);

}  // namespace pelagic::peers
