// A boat that the user steers with thrust and rudder. It floats by the forces of the water on its
// hull, and leaves its own wake and spray.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <memory>

#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/floating/hull_spray.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/frame.hpp"

namespace pelagic::viewer {

/// Control inputs; [-1, 1] each.
struct Helm {
    double thrust = 0;  ///< positive: ahead; negative: astern
    double rudder = 0;  ///< positive: to starboard; negative: to port
};

class SteeredBoat {
   public:
    /// Creates a boat at rest on the water.
    /// \param frame  with queries and velocities, for all functions
    /// \param place_m  position, x and z
    /// \param heading_rad  angle from +x towards +z
    SteeredBoat(const Frame& frame, glm::dvec2 place_m, double heading_rad);
    SteeredBoat(const SteeredBoat&) = delete;  // its spray points to its hull
    SteeredBoat& operator=(const SteeredBoat&) = delete;

    /// Puts the boat on other dynamic waves, which outlive the calls, without a wake yet.
    void float_on(DynamicWaves& waves);
    /// Removes the boat's pressure from the waves.
    void leave_water();

    /// Advances the boat to the time of a frame, and presses on the water of the next ones.
    /// \param passed_s  time since the frame of the last call
    void advance(const Frame& frame, double passed_s, const Helm& helm);
    /// Returns the water that the hull threw in the last advance().
    const HullSpray& thrown() const { return thrown_; }

    glm::dvec2 place_m() const;
    double heading_rad() const;
    double speed_mps() const;  ///< over the ground; negative: astern
    /// Returns the pose of gl::Boat.
    glm::dmat4 world_from_boat() const;
    const HullState& state() const { return bodies_->state(body_); }
    const Hull& hull() const { return hull_; }

   private:
    HullForce engine_and_rudder(const Helm& helm) const;

    Hull hull_;
    std::unique_ptr<FloatingBodies> bodies_;
    std::uint32_t body_;
    HullSpray thrown_;
    HullWorkspace workspace_;
};

}  // namespace pelagic::viewer
