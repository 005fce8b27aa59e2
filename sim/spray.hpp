// Spray: droplets that leave breaking crests, and droplets of emitters that an application adds.
//
//   Spray spray;
//   while (const auto tick_s = spray.missing_tick_s(time_s))
//       spray.add_tick(ocean.frame_at(*tick_s), camera_x, camera_z);
//   for (const SprayDroplet& droplet : spray.droplets_at(time_s)) ...
//
// Droplets leave at ticks, ten a second. At a tick each cell of a grid in the world has one
// candidate position, which depends on the tick, the cell and the seed. The candidate makes
// droplets if the water breaks there (snapshot_foam.hpp), more of them in strong wind. Some spray
// is expected from Beaufort 5 on (WMO 2018, "Manual on Marine Meteorological Services"), so the
// amount rises from none at 8 m/s to its maximum at 20.8 m/s. From there on, Beaufort 9, fine
// droplets are torn off the crests along the wind (spindrift).
//
// A droplet moves in closed form under gravity and linear drag. The relaxation time is that of the
// terminal velocity of its size (Gunn and Kinzer 1949). Drops of spray have diameters of 0.1 mm to
// some millimetres, and there are more of them than can be computed. So each droplet stands for a
// clump of drops, with a radius that grows and an opacity that falls. The speeds at launch and the
// number, radii and opacities of clumps are chosen by eye.
//
// The droplets at a time are those of the ticks of one lifetime. They are bit-identical after a
// jump in time and step by step, on every machine, if the centre is equal.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "pelagic/message/numeric_field.hpp"
#include "pelagic/simd/allocator.hpp"

namespace pelagic {

struct Frame;

/// A clump of drops; position and velocity are in the world.
struct SprayDroplet {
    double x_m = 0, y_m = 0, z_m = 0;
    float velocity_x_mps = 0, velocity_y_mps = 0, velocity_z_mps = 0;
    float radius_m = 0;
    float opacity = 0;  ///< at its middle, [0, 1]
    float age_s = 0;    ///< since it left the water
};

/// Droplets that leave a ball at once, for instance at the bow of a ship.
struct SprayEmitter {
    double time_s = 0;  ///< at which they leave; [-1e9, 1e9]
    /// Centre of the ball; each in [-1e8, 1e8].
    double x_m = 0, y_m = 0, z_m = 0;
    double extent_m = 0;  ///< radius of the ball; [0, 100]
    /// Mean velocity; each in [-100, 100].
    double velocity_x_mps = 0, velocity_y_mps = 0, velocity_z_mps = 0;
    double spread_mps = 0;   ///< largest deviation from the mean velocity; [0, 100]
    double radius_m = 0.05;  ///< of a droplet as it leaves; [0.001, 1]
    double drop_mm = 1;      ///< diameter of drops, which sets the drag; [0.1, 5]
    int count = 1;           ///< droplets; [0, 8192]
};

struct SprayOptions {
    double reach_m = 80;  ///< spray leaves crests within this distance of the centre; [10, 200]
    double amount = 1;    ///< factor on the number of droplets of crests; [0, 10]
    std::uint32_t seed = 1;
    /// Spray repeats with the loop of the sea: SeaState::loop_period_s, or 0 for no loop. [1, 1e6]
    double loop_period_s = 0;
};

/// Returns the table of an emitter's fields.
std::span<const NumericField<SprayEmitter>> spray_emitter_fields();
/// Returns the table of the options.
std::span<const NumericField<SprayOptions>> spray_fields();

/// Returns an empty string for a usable emitter, else a message about the first invalid field.
std::string check(const SprayEmitter& emitter);
/// As above, for options.
std::string check(const SprayOptions& options);

/// Spray of one sea. Not thread-safe: one thread at a time calls its functions, which compute on
/// that thread. Nothing is allocated after construction.
class Spray {
   public:
    static constexpr std::size_t max_droplets = 8192;
    static constexpr double max_lifetime_s = 1.5;

    /// \throws std::invalid_argument  check(options), unless it is empty
    /// \throws std::bad_alloc         if memory is exhausted
    explicit Spray(const SprayOptions& options = {}, const Allocator& memory = {});
    ~Spray();
    Spray(const Spray&) = delete;
    Spray& operator=(const Spray&) = delete;

    /// Returns the time of the next tick that droplets_at(time_s) needs, or nothing if it has all.
    /// Ticks before the first are the 15 or 16 of a lifetime, as after a jump in time.
    /// \throws std::invalid_argument  if time_s is not in [-1e9, 1e9]
    std::optional<double> missing_tick_s(double time_s) const;

    /// Adds the droplets that leave at a tick, Frame::time_s. If the tick does not follow the last
    /// one, droplets of earlier ticks are discarded.
    ///
    /// Each tick adds at most 512 droplets of crests; if there are more, each is less probable. The
    /// heights of dynamic waves and of a shore are included. The foam of their waves makes no
    /// spray. With Frame::water_frame the current carries the droplets of crests and of emitters.
    /// \param center_x_m,center_z_m  centre of the spray, usually the camera; each in [-1e8, 1e8]
    /// \throws std::invalid_argument  if the frame was made without OceanOptions::velocities, its
    ///                                time is no tick, or the centre is out of range; nothing is
    ///                                changed then
    void add_tick(const Frame& frame, double center_x_m, double center_z_m);

    /// Adds droplets of emitters. Their wind and water frame are those of the last tick. A jump in
    /// time keeps them. If there are more than 8192, the oldest are discarded.
    /// \throws std::invalid_argument  if an emitter is invalid, or the emitters of a call have more
    ///                                than 8192 droplets; nothing is changed then
    void emit(std::span<const SprayEmitter> emitters);

    /// Returns the droplets at a time, at most 8192: first those of emitters, then those of crests,
    /// each with the newest first. Droplets that fell below the water are not removed. The span
    /// stays valid until the next call. \pre !missing_tick_s(time_s), otherwise droplets of the
    /// missing ticks are missing
    std::span<const SprayDroplet> droplets_at(double time_s);

    const SprayOptions& options() const;  ///< the options of construction
    double tick_s() const;                ///< interval of ticks: 0.1, or nearly for a loop
    std::size_t memory_bytes() const;     ///< all memory of the object

   private:
    struct State;
    std::unique_ptr<State> state_;
};

}  // namespace pelagic
