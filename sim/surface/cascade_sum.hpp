// Displacement of a frame between texels: the sum of its cascades. Each cascade is periodic and
// interpolated bilinearly, as a GPU samples it, in double precision.
#pragma once

#include "pelagic/sim/frame.hpp"

namespace pelagic {

/// Metres.
struct Displacement {
    double dx = 0, height = 0, dz = 0;
};

/// Returns the displacement of one cascade at the reference position (x_m, z_m), anywhere in the
/// world.
Displacement displacement_of(const Cascade& cascade, double x_m, double z_m);

/// Returns the displacement of all cascades at the reference position (x_m, z_m), anywhere in the
/// world.
Displacement displacement_of(const Frame& frame, double x_m, double z_m);

}  // namespace pelagic
