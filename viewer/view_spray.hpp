// Spray of the viewer: an ocean of its own computes the frames of ticks while images are drawn.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <span>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/spray.hpp"

namespace pelagic::viewer {

class ViewSpray {
   public:
    /// \param options  of the ocean; velocities are added
    ViewSpray(const Forecast& forecast, OceanOptions options);

    /// Returns the ocean, to schedule other seas. Its frames belong to this object.
    Ocean& ocean() { return ocean_; }
    /// Waits for the sea of ocean().schedule_sea(sea).
    void complete_sea();
    /// Adds droplets of emitters.
    void emit(std::span<const SprayEmitter> emitters) { spray_.emit(emitters); }
    /// Returns the droplets at a time.
    /// \param schedules_next  starts the frame of the next tick, for a time that advances
    std::span<const SprayDroplet> at(double time_s, const glm::dvec3& viewer_m, bool schedules_next);

   private:
    /// Completes the frame in flight. Returns whether it is that of a tick.
    bool complete(std::optional<double> wanted_s);

    Spray spray_;
    Ocean ocean_;
    std::optional<double> scheduled_s_;  ///< tick of the frame in flight
};

}  // namespace pelagic::viewer
