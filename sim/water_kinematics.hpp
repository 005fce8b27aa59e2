// The motion of the water at any position and depth, by linear theory (Airy):
//
//   head        h(q, s) = sum a cosh k (d - s) / cosh k d cos(phase), s the depth of the water there
//   pressure    rho g (h - y), 0 at the surface
//   velocity    along a wave a omega cosh k (d - s) / sinh k d cos(phase), upwards a omega sinh k (d - s) /
//               sinh k d sin(phase): the water's own, not scaled by choppiness
//   acceleration  -grad(h) g, horizontally and upwards
//
// The depth s is that of Wheeler's stretching (J. D. Wheeler, J. Petroleum Technology, 1970): a point
// at y under a surface at the height e has s = d (e - y) / (d + e), in deep water e - y.
#pragma once

#include <cstddef>
#include <span>

namespace pelagic {

struct Frame;

/// Positions in the world, in metres: y is up, and 0 is the mean level of the sea.
struct WaterPoints {
    std::span<const double> x, y, z;  ///< equally long
    /// Leaves out waves shorter than about this length, metres; at least 0. ExactWater leaves out exactly these. In a
    /// frame, where the cascade of these waves has texels of at most an eighth of the footprint, pressure keeps 90 % or
    /// more of waves of twice the footprint, and 14 % or less of waves of half of it; velocities do with texels of a
    /// sixteenth. Water shallower than half of the footprint counts as one of two depths. Waves of a pond remain,
    /// and those of dynamic waves and a shore.
    double footprint_m = 0;
    /// Of a frame, leaves out only cascades that hold no wave as long as the footprint, which takes no time.
    bool whole_cascades = false;
};

/// Arrays that receive the results. Each span is as long as the points, or empty to leave that
/// result out. No span may overlap another or the points. A position without a sample
/// (SurfacePoints) has the quiet NaN 0x7fc00000. Above the surface the pressure is negative, as if the water
/// reached there, and velocity and acceleration are those at the surface.
struct WaterSamples {
    std::span<float> depth_m = {};      ///< below the surface above the point; negative in the air
    std::span<float> pressure_pa = {};  ///< above that of the air, 0 at the surface
    std::span<float> velocity_x_mps = {}, velocity_y_mps = {}, velocity_z_mps = {};
    std::span<float> acceleration_x_mps2 = {}, acceleration_y_mps2 = {}, acceleration_z_mps2 = {};
};

/// Water at one moment: of a frame (WaterQuery), or the exact sum of waves (ExactWater).
class WaterKinematics {
   public:
    virtual ~WaterKinematics() = default;

    /// Returns the density that pressures are of, kg/m^3.
    double water_density_kgpm3() const { return water_density_kgpm3_; }
    /// Returns the time of the water, seconds.
    double time_s() const { return time_s_; }
    /// Returns the height of the sea floor in the world, metres.
    virtual double floor_m() const = 0;
    /// Returns the frame of the water; null for water without one.
    virtual const Frame* frame_or_null() const { return nullptr; }

    /// Samples the water at the points. Thread-safe.
    /// \throws std::invalid_argument  before it writes, what require_valid() throws
    virtual void sample(const WaterPoints& points, const WaterSamples& samples) const = 0;

    /// \throws std::invalid_argument  for spans of another length than the points, a footprint below 0, or a point
    ///                                below the floor: "y[3] is -60, expected at least -50, the sea floor"
    void require_valid(const WaterPoints& points, const WaterSamples& samples) const;

   protected:
    /// \throws std::invalid_argument  if the density is not in [500, 2000]
    WaterKinematics(double water_density_kgpm3, double time_s);

    double time_s_;

   private:
    double water_density_kgpm3_;
};

}  // namespace pelagic
