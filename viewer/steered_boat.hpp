// A boat that the user steers with thrust and rudder. It floats on the water and leaves a wake.
#pragma once

#include <functional>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>

#include "pelagic/sim/disturbance.hpp"

namespace pelagic::viewer {

/// Control inputs; [-1, 1] each.
struct Helm {
    double thrust = 0;  ///< positive: ahead; negative: astern
    double rudder = 0;  ///< positive: to starboard; negative: to port
};

class SteeredBoat {
   public:
    static constexpr double top_speed_mps = 6, length_m = 7.2, beam_m = 2.5;

    /// \param place_m  position, x and z
    /// \param heading_rad  angle from +x towards +z
    SteeredBoat(glm::dvec2 place_m, double heading_rad) : place_(place_m), heading_(heading_rad) {}

    /// Returns the height of the water at x and z, m.
    using WaterHeight = std::function<double(double x_m, double z_m)>;

    /// Advances the boat. The depression that the boat's own pressure makes is subtracted from the
    /// water height, because it carries the boat.
    /// \param passed_s  time step, s
    /// \param water  water height of the frame that was scheduled after the last press()
    /// \param frame_s  time of that frame, s
    void step(double passed_s, const Helm& helm, const WaterHeight& water, double frame_s);

    /// Returns the boat's pressure on the water, which acts from the next tick.
    /// \param frame_s  time of the frame that was completed last, s
    /// \param tick_s  duration of a tick of the dynamic waves, s
    Disturbance press(double frame_s, double tick_s);

    glm::dvec2 place_m() const { return place_; }
    double heading_rad() const { return heading_; }
    double speed_mps() const { return speed_; }  ///< negative: astern
    double height_m() const { return height_; }  ///< of the waterline above the mean water level
    double pitch_rad() const { return pitch_; }  ///< positive: bow up
    double roll_rad() const { return roll_; }    ///< positive: starboard side down
    /// Returns the pose. Local axes: x forward, y up from the waterline, z to starboard.
    glm::dmat4 world_from_boat() const;

   private:
    void drive(double passed_s, const Helm& helm);
    void float_on(double passed_s, const WaterHeight& water);
    glm::dvec2 ahead() const;
    Disturbance hull() const;
    /// Returns the depression by the boat's own pressure in a frame, with the commands that were
    /// applied when it was scheduled, m.
    double own_depression_m(double frame_s, glm::dvec2 at) const;

    glm::dvec2 place_;
    double heading_, speed_ = 0, turn_rad_ps_ = 0;
    double height_ = 0, pitch_ = 0, roll_ = 0;
    bool floats_ = false;          ///< true after the first step()
    bool has_pressure_ = false;    ///< true after the first press()
    Disturbance pressure_;         ///< result of the last press()
    double pressure_shown_s_ = 0;  ///< time of the frame that shows pressure_ at its position, s
};

}  // namespace pelagic::viewer
