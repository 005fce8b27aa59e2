// A box's part in dynamic waves: it presses as much as it weighs, and feels the wakes of all others, and what its own sends
// back, but not the hollow that it lies in, whose pressure is already its buoyancy.
//
// The grid stands in the world and does not know that the waves of the wind carry its water to and fro, and a box with it. So a press
// goes with its box only as that moves through the water (BoxWake::press).
//
//   const Frame& frame = ocean.complete();
//   for (...) wakes[i].press(ocean, boxes[i], tick_s);
//   ocean.schedule(next_s);                            // a tick of the water later
//   step(boxes, SurfaceQuery(frame), step_s, hull, wakes);
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pelagic/examples/buoyancy/floating_box.hpp"
#include "pelagic/sim/disturbance.hpp"
#include "pelagic/sim/ocean.hpp"

namespace pelagic::buoyancy {

/// From +x towards +z, of the box's length; [-pi, pi]. Only + - * / and our own sine: the same bits everywhere.
double heading_rad(const BoxState& state);

/// An ellipsoid's lower half as long and broad as the box, of as much water as the box displaces at rest.
Disturbance pressure_of(const FloatingBox& box);

class BoxWake {
   public:
    /// The press follows a box so fast that the water carries to and fro: less, and it makes waves by a way that it goes with the
    /// water; more, and it lags behind a box that drifts with it.
    static constexpr double return_s = 10;

    /// A source of the ocean from its next frame on, which has dynamic waves (OceanOptions::dynamic_waves). It weighs nothing at first, and
    /// all after launch_s(): put in at once, a barge of 4,000 t is a splash that rocks all others for a minute.
    BoxWake(Ocean& ocean, const FloatingBox& box);

    /// The box lies here now, `tick_s` after the press before. Between complete() and schedule(), whose frames are a tick of the water
    /// apart.
    void press(Ocean& ocean, const FloatingBox& box, double tick_s);

    /// Four periods of waves as long as the box, which a slower change hardly makes.
    static double launch_s(const BoxOptions& box);

    /// Takes the box's own hollow out of what its columns found in the frame completed last.
    void leave_out(HullWater& hull, std::size_t first, std::size_t columns, double tick_s) const;

   private:
    Disturbance pressing(const FloatingBox& box) const;

    std::uint32_t source_;
    double afloat_s_ = 0;
    glm::dvec3 box_m_;       ///< at the press before
    glm::dvec3 pressure_m_;  ///< of the press
    /// As they were said: for the frame to come, for that completed last, which shows the tick before it, and for that one.
    std::array<Disturbance, 3> pressures_;
};

}  // namespace pelagic::buoyancy
