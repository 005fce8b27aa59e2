// The motion of the waves of a cascade below its surface: pressure and velocity at a few depths, on
// grids that are the coarser the deeper they lie, because short waves fade first.
//
// Grid 0 has N / 2 texels, the velocity at the surface and the pressure at a depth of 3 texels of the
// cascade. Grid 1 has N / 4 texels, and velocity and pressure at 6 texels, grid 2 those at 12, and so on.
// The last grid lies at the bottom, or where only the longest wave reaches. At the surface the pressure
// is the cascade's height. Between depths three of them are added, with signed weights that fit
// cosh k(d - y) / cosh kd best (spectrum/depth_weights.hpp).
//
// Texels hold coefficients of cubic B-splines (M. Unser, IEEE Signal Processing Magazine 16(6), 1999):
// their sum interpolates waves of 4 texels with an error of 3 %, and of 6 texels with one of 0.4 %.
#pragma once

#include <array>
#include <cstddef>

namespace pelagic {

/// A grid of the waves' motion.
struct WaterGrid {
    /// Below the surface.
    double velocity_depth_m = 0, head_depth_m = 0;
    int resolution = 0;  ///< texels along a side, a power of two
    /// Texels of four values: the velocity in the world's axes in m/s, and the pressure over density and
    /// gravity, without that at rest, in m. Rows have `resolution` texels and WaterLevels::repeated more,
    /// which repeat the first ones.
    const float* texels = nullptr;
};

/// Weights of three levels for a depth, and their derivatives in that depth, 1/m.
struct DepthWeights {
    std::array<float, 3> value{}, slope{};
};

/// The depths of a quantity from the surface down, and weights between them.
struct DepthLadder {
    static constexpr std::size_t max_levels = 12;
    /// Steps of the tabulated weights from one level to the next.
    static constexpr std::size_t steps = 16;

    /// Returns the first of the three levels whose weights are those between levels i and i + 1.
    static constexpr std::size_t first_of(std::size_t i) { return i > 0 ? i - 1 : 0; }

    std::array<double, max_levels> depths_m{};
    std::array<float, max_levels> steps_per_m{};  ///< of the weights below each level
    std::size_t count = 0;                        ///< at least 3
    std::array<std::array<DepthWeights, steps + 1>, max_levels - 1> weights{};

    /// What leaves out waves shorter than a footprint: a level's weight is the sum over the wave numbers of these
    /// numbers times the fraction that remains of each. `along`: pressure, horizontal velocity; `up`: vertical one.
    struct Filter {
        static constexpr std::size_t waves = 32;
        using OfLevels = std::array<std::array<float, waves>, max_levels>;
        std::array<float, waves> k{};  ///< rad/m
        OfLevels along{}, up{};
    };
    Filter filter;
};

/// The levels of a cascade.
struct WaterLevels {
    static constexpr int repeated = 4;
    static constexpr std::size_t max_grids = DepthLadder::max_levels - 1;
    /// Shortest wave of the velocity at the surface, in texels of the cascade. Waves of fewer than six are
    /// interpolated badly, but stacks hold much of their energy: without them velocities would be too small.
    static constexpr double shortest_velocity_texels = 4.2;

    std::array<WaterGrid, max_grids> grids;
    /// 0: none; 1: only the velocity at the surface.
    std::size_t count = 0;
    double longest_wave_m = 0;  ///< of the cascade
    double water_m = 0;         ///< depth of the water
    /// Mean drift in the world's axes that velocities of the grids lack, at the surface. At the depth s, drift /
    /// (1 + drift_k s / 2)^4 is added: near e^(-2 k s), the decrease of Stokes' drift, for waves of many lengths.
    double drift_x_mps = 0, drift_z_mps = 0, drift_k = 0;
    /// Level g of the velocity is that of grid g. Level 0 of the head is the surface, and level g + 1 is that
    /// of grid g.
    const DepthLadder *velocity = nullptr, *head = nullptr;

    /// Returns whether there is velocity at the surface.
    bool has_surface() const { return count > 0; }
    /// Returns whether there is water below the surface.
    bool has_depth() const { return count > 1; }
};

}  // namespace pelagic
