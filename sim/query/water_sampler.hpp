// Samples of a cascade's water levels (sim/water_levels.hpp) at a reference point.
#pragma once

#include <array>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/query/point_chunk.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic {

/// Pressure over density and gravity, and its derivatives along the cascade's axes in texels, and
/// downwards in metres.
struct HeadSample {
    float value = 0, along = 0, across = 0, down = 0;
};

/// What is wanted of a HeadSample.
enum class WaterDerivatives { none, down, all };

/// Motion of a cascade's waves.
struct WaterMotion {
    std::array<float, 3> velocity_mps{};  ///< in the world's axes
    HeadSample head;
};

/// Returns the water's velocity at the surface in the world's axes, m/s. \pre cascade.water.has_surface()
std::array<float, 3> surface_velocity(const Cascade& cascade, const ReferenceCell& at);

/// Returns the height of a cascade's waves above its level, and its derivatives.
HeadSample surface_head(const SurfaceTexels& texels, float level_m, const ReferenceCell& at,
                        Interpolation interpolation);

/// Returns the motion at a depth.
/// \param depth_m  at least 0
/// \param surface  surface_head()
/// \pre cascade.water.has_depth()
WaterMotion motion_at(const Cascade& cascade, double depth_m, const ReferenceCell& at, const HeadSample& surface,
                      WaterDerivatives wanted);

/// Weights of a cascade's levels.
struct LevelSums {
    using Weights = std::array<float, DepthLadder::max_levels>;
    Weights head{}, head_slope{};  ///< the slope downwards, 1/m
    Weights along{}, up{};         ///< of horizontal and vertical velocity
    bool is_zero = true;
};

/// Returns the weights of the surface that leave out waves shorter than about the footprint.
/// \param footprint_m  above 0 \pre cascade.water.has_depth()
LevelSums sums_without(const Cascade& cascade, double footprint_m);
/// Returns the weights of a depth that leave out the waves that those of the surface do.
LevelSums sums_below(const Cascade& cascade, const LevelSums& surface, double depth_m);

/// As motion_at(), with weights of levels.
WaterMotion motion_of(const Cascade& cascade, const LevelSums& sums, const ReferenceCell& at,
                      const HeadSample& surface, bool has_slopes);

}  // namespace pelagic
