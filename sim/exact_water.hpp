// The exact sum over the waves of a sea: surface, pressure, velocity and acceleration of its water at
// any position and depth, wave by wave, for servers and tests.
//
//   ExactWater water(sea);
//   water.set_time(12.5);
//   water.sample({.x = xs, .y = ys, .z = zs}, {.pressure_pa = pressures, .velocity_y_mps = rise});
//
// The waves are those of frames of an Ocean, with equal phases: with choppiness 0 a texel has the
// height of this sum at its position. The sum is that of linear theory at fixed positions
// (water_kinematics.hpp). Choppiness and lean, which displace the drawn surface, have no part in it.
//
// Frequencies are those of the loop, so accelerations equal the rate of change of velocities within the
// loop's rounding of the square of each frequency. Surface tension changes frequencies only. The second
// harmonic of a regular wave is the whole one of Stokes, and it moves the water as a wave of its own.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/message/numeric_field.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/sim/water_frame.hpp"
#include "pelagic/sim/water_kinematics.hpp"

namespace pelagic {

enum class Isa;

struct ExactWaterOptions {
    // generated from schema/exact_water.toml: members
    double water_density_kgpm3 = 1025;  ///< density of the water; [500, 2000]
    WaterFrame water_frame = {};        ///< sea level and current
    /// Executor that computes the waves at construction. Null: the calling thread.
    std::shared_ptr<Executor> executor = {};
    std::optional<Isa> isa = {};  ///< instruction set, as OceanOptions::isa
    // end of generated
};

/// Returns the table of its fields.
std::span<const NumericField<ExactWaterOptions>> exact_water_fields();

/// Returns an empty string for usable options, else a message about the first invalid field.
std::string check(const ExactWaterOptions& options);

/// The water of a sea at one moment. A sample takes time in proportion to wave_count(), some 25
/// microseconds for four cascades of 128. Results do not depend on the other points, the thread or
/// the instruction set.
class ExactWater final : public WaterKinematics {
   public:
    /// Computes the waves, and moves them to the time 0.
    /// \throws std::invalid_argument  check(sea), unless it is empty; for a pond, whose octaves are no
    ///                                linear waves; for an option out of range; what choose_isa() throws
    explicit ExactWater(const SeaState& sea, const ExactWaterOptions& options = {});
    ~ExactWater() override;
    ExactWater(ExactWater&&) noexcept;
    ExactWater& operator=(ExactWater&&) noexcept;

    /// Moves the water to a time. It takes about as long as a sample, and allocates nothing.
    /// \pre no other thread uses this object
    /// \throws std::invalid_argument  if the time is not finite
    void set_time(double time_s);
    /// Shifts the world's origin, as Ocean::set_origin(), for samples from now on.
    /// \pre no other thread uses this object
    /// \throws std::invalid_argument  out of range
    void set_origin(double x_m, double z_m);
    /// Returns the water at another time. Both share the waves. Thread-safe.
    /// \throws std::invalid_argument  if the time is not finite
    ExactWater at(double time_s) const;

    /// Returns the depth below the mean level, metres. Analytic seas have 1e7.
    double depth_m() const;
    /// Returns the number of wave vectors. Each has two waves, which run in opposite directions.
    std::size_t wave_count() const;
    double floor_m() const override;

    void sample(const WaterPoints& points, const WaterSamples& samples) const override;

    /// Samples the undisplaced surface: its height, its normal, and the velocity of the water there.
    /// The Jacobian is 1, the error 0, and each position with a sample has converged. Thread-safe.
    /// \throws std::invalid_argument  before it writes, for spans of another length than the points,
    ///                                foam, or a footprint below 0
    void sample_surface(const SurfacePoints& points, const SurfaceSamples& samples) const;
    /// Checks points and arrays. \throws std::invalid_argument  what sample_surface() throws
    void check(const SurfacePoints& points, const SurfaceSamples& samples) const;

   private:
    struct Waves;
    struct Moment;
    struct Chunk;

    ExactWater(std::shared_ptr<const Waves> waves, const WaterFrame& water);
    bool has_sample(double x, double z) const;
    template <class Points>
    void load_positions(const Points& points, Chunk& chunk) const;
    void sum_heights(Chunk& chunk, double footprint_m) const;
    void sum_water(Chunk& chunk, double footprint_m) const;

    std::shared_ptr<const Waves> waves_;
    std::unique_ptr<Moment> moment_;
};

}  // namespace pelagic
