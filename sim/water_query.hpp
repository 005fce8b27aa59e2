// Pressure, velocity and acceleration of a frame at any position and depth.
//
//   Ocean ocean(sea, {.queries = true, .depth = true});
//   const WaterQuery water(ocean.complete());
//   water.sample({.x = xs, .y = ys, .z = zs}, {.pressure_pa = pressures});
//
// The water at (x, y, z) is that of the reference point that is drawn at (x, z), at the depth below it
// (water_kinematics.hpp). Waves of the cascades decrease with depth by planes at a few depths
// (water_levels.hpp): with cubic interpolation of the surface within 3 % of a wave's amplitude for the
// pressure of waves from 8 texels on, and for velocities from 16; accelerations within 10 %. Pressure is 0
// on the surface that is queried, but for dynamic waves: these, and the waves of a shore and of a pond, do
// not decrease with depth. Those of a pond move no water. Velocities have a mean besides the waves, without which water
// that follows them would not drift as Stokes (1847) found (WaterLevels::drift_x_mps); ExactWater has none.
#pragma once

#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/sim/water_kinematics.hpp"

namespace pelagic {

struct WaterQueryOptions {
    SurfaceQueryOptions surface = {};
    double water_density_kgpm3 = 1025;  ///< [500, 2000]
};

/// A query of a frame, valid as long as the frame's views. Thread-safe. Methods allocate nothing and never
/// wait. Results are bit-identical on every machine.
class WaterQuery final : public WaterKinematics {
   public:
    /// \throws std::invalid_argument  if the frame was made without OceanOptions::queries or depth, or an
    ///                                option is out of range
    explicit WaterQuery(const Frame& frame, const WaterQueryOptions& options = {});

    void sample(const WaterPoints& points, const WaterSamples& samples) const override;

    /// Returns the query of the surface.
    const SurfaceQuery& surface() const { return surface_; }
    /// Returns the queried frame.
    const Frame& frame() const { return surface_.frame(); }
    double floor_m() const override { return frame().water_frame.sea_level_m - frame().sea.depth_m; }
    const Frame* frame_or_null() const override { return &frame(); }

   private:
    SurfaceQuery surface_;
};

}  // namespace pelagic
