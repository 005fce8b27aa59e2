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

}  // namespace pelagic
