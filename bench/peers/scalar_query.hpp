// Surface queries one point at a time, in plain code: the same method as sim/surface_query where
// the surface does not fold, and the same bits (tests/peers_test.cpp); and the floor, a bilinear
// lookup that ignores the displacement.
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

/// The height at the point of rest instead of at the point.
float scalar_lookup(const Frame& frame, double x_m, double z_m);

}  // namespace pelagic::peers
