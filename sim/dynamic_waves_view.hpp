// The dynamic waves of a frame (dynamic_waves.hpp).
#pragma once

#include <cstdint>
#include <span>

#include "pelagic/sim/frame_bounds.hpp"

namespace pelagic {

/// The dynamic-wave grid, whose height adds to that of the cascades at the drawn position,
/// x = undisplaced x + Dx, z alike. Waves fade towards its edges, where they are 0.
///
/// Texel (i, j) of the water's frame has the position x = i texel_m, z = j texel_m and is in column
/// i mod N of row j mod N. The grid has first_x <= i < first_x + N, and first_z <= j < first_z + N.
struct DynamicWavesView {
    int resolution = 0;  ///< N, a power of two; 0: there are no dynamic waves
    double texel_m = 0;
    std::int64_t first_x = 0, first_z = 0;
    std::span<const float> height_m;  ///< N^2
    /// N^2; at the view's time, with an error of (omega tick)^2 / 3 of a wave's velocity. Impulses
    /// have no initial velocity.
    std::span<const float> vertical_velocity_mps;
    std::span<const std::uint8_t> foam;  ///< N^2, 0 none to 255 full
    FrameBounds bounds;                  ///< of the height

    /// Returns whether there are dynamic waves.
    explicit operator bool() const { return resolution > 0; }
};

}  // namespace pelagic
