// What a frame shows of dynamic waves (dynamic_waves.hpp).
#pragma once

#include <cstdint>
#include <span>

namespace pelagic {

/// A grid of the sea whose height adds to that of the cascades, where water is drawn: at x = rest x + Dx, z alike. Texel (i, j) of the
/// world's grid stands at x = i texel_m, z = j texel_m and is kept in column i mod N of row j mod N; the grid has first_x <= i <
/// first_x + N. Waves fade towards its edges, where they are 0.
struct DynamicWavesView {
    int resolution = 0;  ///< N, a power of two; 0: the ocean has no such water
    double texel_m = 0;
    std::int64_t first_x = 0, first_z = 0;
    std::span<const float> height_m;  ///< N^2
    /// The same: the vertical velocity at the moment that is shown, to (omega tick)^2 / 3 of a wave's. What is added at once brings none.
    std::span<const float> vertical_velocity_mps;
    std::span<const std::uint8_t> foam;  ///< the same
    float height_min_m = 0, height_max_m = 0;

    explicit operator bool() const { return resolution > 0; }
};

}  // namespace pelagic
