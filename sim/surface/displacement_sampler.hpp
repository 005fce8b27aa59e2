// The displacement between the texels: bilinear and periodic, as a GPU samples it, in double.
#pragma once

#include "pelagic/sim/frame.hpp"

namespace pelagic {

/// Metres.
struct Displacement {
    double dx = 0, height = 0, dz = 0;
};

class DisplacementSampler {
   public:
    /// \param frame  stays valid meanwhile
    explicit DisplacementSampler(const Frame& frame);

    /// Of the point that rests at (x_m, z_m), anywhere in the world.
    Displacement at(double x_m, double z_m) const;

   private:
    const Frame& frame_;
    double texels_per_m_;
};

}  // namespace pelagic
