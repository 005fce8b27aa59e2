// The sum of a frame's cascades at undisplaced positions: displacement, velocity, slopes,
// compression and foam.
//
// Each cascade is periodic and interpolated bilinearly, as a GPU samples it, in scalar code. Results
// are bit-identical on every machine. Dynamic waves and a shore are not included. Positions are in
// metres in the water's frame (water_frame.hpp), anywhere in the world, and finite. Functions do
// not allocate, and any thread may call them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "pelagic/sim/frame.hpp"

namespace pelagic {

/// Displacement in metres, or its derivative in time in m/s.
struct Displacement {
    double dx = 0, height = 0, dz = 0;
};

/// Returns the displacement of a cascade, in metres. \pre the frame has planes
/// (OceanOptions::planes)
Displacement displacement_of(const Cascade& cascade, double x_m, double z_m);
/// Returns the sum over all cascades. \pre the frame has planes
Displacement displacement_of(const Frame& frame, double x_m, double z_m);

/// Returns the derivative of displacement_of() in time, in m/s. \pre the frame has velocities
/// (OceanOptions::velocities)
Displacement velocity_of(const Cascade& cascade, double x_m, double z_m);
/// Returns the sum over all cascades. \pre the frame has velocities
Displacement velocity_of(const Frame& frame, double x_m, double z_m);

/// Returns the derivatives of the displacement along the world's axes, with the differences of
/// Cascade::slopes_rgba8 and without their rounding to bytes. Variances are 0.
/// \pre the frame has planes
SurfaceSlopes slopes_of(const Cascade& cascade, double x_m, double z_m);
/// Returns the sum over all cascades. normal_of() gives the normal and the Jacobian of the sum.
/// \pre the frame has planes
SurfaceSlopes slopes_of(const Frame& frame, double x_m, double z_m);

/// Returns the Jacobian of the summed surface: the area of the water over its undisplaced area,
/// below 0 where the surface is overturned. \pre the frame has planes
double jacobian_of(const Frame& frame, double x_m, double z_m);

/// Returns the weighted compression of all cascades (snapshot_foam.hpp), in standard deviations; 0
/// without OceanOptions::foam. \pre the frame has planes
double compression_of(const Frame& frame, double x_m, double z_m);

/// Samples the foam of a frame's cascades. A view of the frame.
class FoamSampler {
   public:
    /// \param frame  must outlive the sampler, with its views
    explicit FoamSampler(const Frame& frame);

    /// Returns whether the frame's cascades have foam.
    bool has_foam() const { return has_foam_; }
    /// Returns the foam of water with the undisplaced position (x_m, z_m), [0, 1].
    /// \param weights  a factor of each cascade's compression, as of a shore; empty: all 1
    /// \pre has_foam()
    float at(double x_m, double z_m, std::span<const float> weights = {}) const;

   private:
    std::span<const Cascade> cascades_;
    const SnapshotFoam& foam_;
    bool has_foam_;
    /// Slots of snapshots that have an effect, the newest first.
    std::array<std::uint8_t, SnapshotFoam::slots> slots_{};
    std::size_t slot_count_ = 0;
};

}  // namespace pelagic
