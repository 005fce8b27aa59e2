// A hull that floats on the waves of an ocean, and on dynamic waves, into which it presses its
// wake. In an ocean with spray it throws some, and leaves foam at its bow and behind its stern. Steps
// are 1/60 s, from the launch on; between steps the pose is interpolated.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <optional>
#include <string>

#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/floating/hull_spray.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/events/event_player.hpp"
#include "pelagic/tools/hulls/hull_options.hpp"

namespace pelagic::tools {

/// A hull at a time. Angles in radians.
struct HullMoment {
    HullState state;
    double heave_m = 0;      ///< above the height at rest in still water
    double heading_rad = 0;  ///< from +x (east) towards +z (south)
    double pitch_rad = 0;    ///< bow up
    double roll_rad = 0;     ///< starboard down
    double draught_m = 0;    ///< of the lowest vertex, below the plane of the water at the hull
    double displaced_m3 = 0;
};

class HullPlayer {
   public:
    static constexpr int steps_per_s = 60;
    static constexpr double launch_s = 10;  ///< from the launch to the first time

    /// Launches the hull on the surface, with the velocity of the water.
    /// \param ocean  with queries and velocities; its frames are invalid after each call
    /// \param has_spray  whether the ocean has OceanOptions::spray
    /// \param waves  begun at begins_s(first_s)
    /// \pre both outlive this object
    HullPlayer(const HullLaunch& launch, Ocean& ocean, EventPlayer& waves, double first_s,
               std::shared_ptr<Executor> executor, bool has_spray = false);

    /// Returns the time of the launch.
    static double begins_s(double first_s);

    /// Returns the hull at a time. \pre time_s is not before first_s or that of the previous call
    HullMoment at(double time_s);

    /// Returns the pose of the mesh, world from hull.
    glm::dmat4 world_from_mesh(const HullMoment& moment) const;

   private:
    void step();
    void break_water(const Frame& frame);
    Frame frame_at(std::int64_t step);

    HullLaunch launch_;
    Ocean& ocean_;
    EventPlayer& waves_;
    FloatingBodies bodies_;
    std::uint32_t body_;
    std::int64_t step_;  ///< number of the state's step, counted from time 0
    HullState before_;   ///< a step earlier
    std::optional<HullSpray> thrown_;  ///< none in an ocean without spray
    HullWorkspace workspace_;
};

/// Returns "time,x,y,z,...", the names of hull_row()'s values.
std::string hull_columns();

/// Returns a row without its line break: metres, degrees, m/s and m^3, of nine digits.
/// \param as_json  an object instead of values and commas
std::string hull_row(double time_s, const HullMoment& moment, bool as_json);

}  // namespace pelagic::tools
