// Position, velocity and breaking of water at reference positions of a frame, for spray.
#pragma once

#include <array>
#include <cstddef>

#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

/// A point of the surface as a GPU draws it: bilinear between texels.
struct SurfacePoint {
    double x_m, y_m, z_m;
    std::array<double, 3> velocity_mps;  ///< of the water
};

/// Samples a frame. Scalar code, so results are bit-identical on every machine.
class BreakingSurface {
   public:
    /// \pre the frame has velocities
    explicit BreakingSurface(const Frame& frame);

    /// Returns the sum of the weighted compressions of all cascades, in standard deviations
    /// (snapshot_foam.hpp). Compressions are central differences at the nearest texel.
    double compression(double x_m, double z_m) const;
    /// Returns the water of a reference position, with the frame's dynamic waves and shore.
    SurfacePoint at(double x_m, double z_m) const;

   private:
    const Frame& frame_;
    std::array<SurfaceTexels, max_cascades> texels_;
};

}  // namespace pelagic
