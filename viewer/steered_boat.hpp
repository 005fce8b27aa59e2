// A boat that somebody steers: thrust, rudder, and the water that it lies on, where it leaves a wake.
#pragma once

#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "pelagic/sim/disturbance.hpp"

namespace pelagic::viewer {

/// What is at the wheel, both within [-1, 1].
struct Helm {
    double thrust = 0;  ///< ahead, or astern
    double rudder = 0;  ///< to starboard, or to port
};

class SteeredBoat {
   public:
    static constexpr double top_speed_mps = 6, length_m = 7.2, beam_m = 2.5;

    /// \param heading_rad  from +x towards +z
    SteeredBoat(glm::dvec2 place_m, double heading_rad) : place_(place_m), heading_(heading_rad) {}

    /// Height of the water at x and z, metres.
    using WaterHeight = std::function<double(double x_m, double z_m)>;

    /// Goes on for so long, on the water of the frame of that time, the one scheduled after the last press(). The boat's own hollow is
    /// left out of it: that is what carries it.
    void step(double passed_s, const Helm& helm, const WaterHeight& water, double frame_s);

    /// What it does to the water from the tick after that frame on: the one completed last. \param tick_s  of the water
    Disturbance press(double frame_s, double tick_s);

    glm::dvec2 place_m() const { return place_; }
    double heading_rad() const { return heading_; }
    double speed_mps() const { return speed_; }  ///< ahead; astern below 0
    double height_m() const { return height_; }  ///< of its waterline above rest
    double pitch_rad() const { return pitch_; }  ///< its bow up
    double roll_rad() const { return roll_; }    ///< its starboard side down
    /// Its own axes: x forward, y up from the waterline, z to starboard.
    glm::dmat4 world_from_boat() const;

   private:
    void drive(double passed_s, const Helm& helm);
    void float_on(double passed_s, const WaterHeight& water);
    glm::dvec2 ahead() const;
    Disturbance hull() const;
    /// Of the water that the frame shows, with the commands applied when it was scheduled.
    double own_hollow_m(double frame_s, glm::dvec2 at) const;

    glm::dvec2 place_;
    double heading_, speed_ = 0, turn_rad_ps_ = 0;
    double height_ = 0, pitch_ = 0, roll_ = 0;
    bool floats_ = false;     ///< it has been on the water once
    bool pressures_ = false;  ///< by this, where the frame of that time shows it
    Disturbance pressure_;
    double pressed_shown_s_ = 0;
};

}  // namespace pelagic::viewer
