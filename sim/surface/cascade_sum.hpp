// The displacement of a frame between the texels: the sum of its cascades, each bilinear and periodic, as a GPU samples them; in
// double.
#pragma once

#include "pelagic/sim/frame.hpp"

namespace pelagic {

/// Metres.
struct Displacement {
    double dx = 0, height = 0, dz = 0;
};

/// What one cascade adds to the point that rests at (x_m, z_m), anywhere in the world.
Displacement displacement_of(const Cascade& cascade, double x_m, double z_m);

/// The same of all cascades.
Displacement displacement_of(const Frame& frame, double x_m, double z_m);

}  // namespace pelagic
