// Stages `slopes+mipmaps` and `slopes tail` of one cascade: from its surface to the two maps of sim/slope_sum.hpp.
#pragma once

#include <cstddef>
#include <cstdint>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/slope_sum.hpp"
#include "pelagic/sim/surface/mipmaps.hpp"
#include "pelagic/sim/texture_targets.hpp"

namespace pelagic {

/// Ranges for a cascade whose waves have the mean squares h_x^2 + h_z^2 of slopes and (D_xx + D_zz)^2 of convergence at choppiness 1, which
/// is the larger one in shallow water. Slopes: four times the root of the larger, which is at least four standard deviations along any
/// axis and five where waves go both ways. Variances: three times the mean square slope. A sea without waves gets ranges too.
SlopeRanges slope_ranges(double mean_square_slope, double mean_square_convergence);

/// Where slopes come from and where they go; a view.
struct SlopeMaps {
    const float* surface;  ///< column blocks (wave_blocks.hpp) for the kernels' lanes
    int resolution;
    std::size_t block_stride;     ///< floats between column blocks
    double side_m;                ///< of the cascade
    double cosine = 1, sine = 0;  ///< how its axes are rotated, GradientsJob
    SlopeRanges ranges;           ///< positive
    std::uint16_t* rgba16f;       ///< 4 N^2, null if nobody wants them
    ShownFoam foam;               ///< with them
    TextureTargets::Chain slopes, moments;
    MipAverages* averages;  ///< of slope_planes planes

    /// Jobs of the first stage; they may run side by side.
    std::size_t jobs() const;
    void make(const Kernels& kernels, std::size_t job) const;
    /// The second stage.
    void make_tail(const Kernels& kernels) const;

   private:
    float slope_step() const { return ranges.slope / 127.f; }
    float variance_factor() const { return slope_step() * slope_step() / ranges.variance; }
};

}  // namespace pelagic
