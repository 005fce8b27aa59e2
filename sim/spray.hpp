// Spray: droplets that leave breaking crests, and droplets of emitters that an application adds.
//
//   Ocean ocean(sea, {.spray = SprayOptions{}});
//   ocean.set_spray_center(camera_x, camera_z);
//   ocean.emit(emitters);
//   for (const SprayDroplet& droplet : ocean.frame_at(time_s).droplets) ...
//
// Droplets leave crests at ticks, two in the time of a foam tick, about eleven a second. At a tick
// each cell of a grid in the water has one candidate position, which depends on the tick, the cell
// and the seed. The candidate makes droplets if the water breaks there (snapshot_foam.hpp), more of
// them in strong wind. Some spray is expected from Beaufort 5 on (WMO 2018, "Manual on Marine
// Meteorological Services"), so the amount rises from none at 8 m/s to its maximum at 20.8 m/s. From
// there on, Beaufort 9, fine droplets are torn off the crests along the wind (spindrift). Droplets
// leave in the tick after that, with the mean velocity of the water between both ticks.
//
// A droplet moves in closed form under gravity and linear drag. The relaxation time is that of the
// terminal velocity of its size (Gunn and Kinzer 1949). Drops of spray have diameters of 0.1 mm to
// some millimetres, and there are more of them than can be computed. So each droplet stands for a
// clump of drops, with a radius that grows and an opacity that falls. The speeds at launch and the
// number, radii and opacities of clumps are chosen by eye.
//
// Droplets of crests are a pure function of the sea, the time and the centre. They are bit-identical
// after a jump in time and step by step, in every loop and on every machine, if the centre is equal.
// A centre that moves counts for the ticks computed from then on. Dynamic waves make no spray and do
// not move it, because they have state. Droplets of emitters are state of the ocean.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "pelagic/message/numeric_field.hpp"

namespace pelagic {

/// Largest number of droplets of a frame, and of emitters that an ocean keeps.
inline constexpr std::size_t max_spray_droplets = 8192;
/// Upper bound of SprayDroplet::age_s.
inline constexpr double max_spray_lifetime_s = 1.5;

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
    // generated from schema/spray_emitter.toml: members
    double time_s = 0;                 ///< time at which they leave; [-1e9, 1e9]
    double x_m = 0, y_m = 0, z_m = 0;  ///< centre of the ball; [-1e8, 1e8]
    double extent_m = 0;               ///< radius of the ball; [0, 100]
    /// Mean velocity; [-100, 100].
    double velocity_x_mps = 0, velocity_y_mps = 0, velocity_z_mps = 0;
    double spread_mps = 0;   ///< largest deviation from the mean velocity; [0, 100]
    double radius_m = 0.05;  ///< radius of a droplet as it leaves; [0.001, 1]
    double drop_mm = 1;      ///< diameter of drops, which sets the drag; [0.1, 5]
    int count = 1;           ///< number of droplets; [0, 8192]
    // end of generated
};

/// Spray of an ocean (OceanOptions::spray).
struct SprayOptions {
    // generated from schema/spray_options.toml: members
    double reach_m = 80;     ///< spray leaves crests within this distance of the centre; [10, 200]
    double amount = 1;       ///< factor on the number of droplets of crests; [0, 10]
    std::uint32_t seed = 1;  ///< seed of the droplets
    // end of generated
};

/// Returns the table of an emitter's fields.
std::span<const NumericField<SprayEmitter>> spray_emitter_fields();
/// Returns the table of the options.
std::span<const NumericField<SprayOptions>> spray_fields();

/// Returns an empty string for a usable emitter, else a message about the first invalid field.
std::string check(const SprayEmitter& emitter);
/// As above, for options.
std::string check(const SprayOptions& options);

}  // namespace pelagic
