// Coupling of a box with dynamic waves. The box is a pressure source of its weight. It responds to
// the wakes of other boxes and to reflections of its own, but not to the depression under it, whose
// pressure is its buoyancy.
//
// The grid is fixed in the world, but wind waves move the water and the box horizontally. The
// pressure source therefore follows only the box's motion relative to the water (BoxWake::press).
//
//   const Frame& frame = ocean.complete();
//   for (...) wakes[i].press(ocean, boxes[i], tick_s);
//   ocean.schedule(next_s);                            // one tick later
//   step(boxes, SurfaceQuery(frame), step_s, hull, wakes);
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pelagic/examples/buoyancy/floating_box.hpp"
#include "pelagic/sim/disturbance.hpp"
#include "pelagic/sim/ocean.hpp"

namespace pelagic::buoyancy {

/// Returns the heading of the box's length axis, from +x towards +z, in [-pi, pi]. Uses + - * / and
/// det::sine_cosine only, so the result is bit-identical on every machine.
double heading_rad(const BoxState& state);

/// Returns a pressure source: the lower half of an ellipsoid with the box's length and beam and the
/// volume of water that the box displaces at rest.
Disturbance pressure_of(const FloatingBox& box);

class BoxWake {
   public:
    /// Time constant with which the pressure source returns to the box. With smaller values the
    /// source follows the oscillation of the water and makes waves. With larger values it lags
    /// behind a drifting box.
    static constexpr double return_s = 10;

    /// Adds a pressure source to the ocean from its next frame on. The pressure increases from zero
    /// to the box's weight within launch_s(), because the sudden weight of a barge of 4,000 t makes
    /// waves for a minute.
    /// \pre the ocean has dynamic waves (OceanOptions::dynamic_waves)
    BoxWake(Ocean& ocean, const FloatingBox& box);

    /// Moves the pressure source to the box. Call it between complete() and schedule(), whose
    /// frames are one tick of the dynamic waves apart. \param tick_s  time since the previous call
    void press(Ocean& ocean, const FloatingBox& box, double tick_s);

    /// Returns four periods of waves with the box's length. A change of this duration makes hardly
    /// any waves.
    static double launch_s(const BoxOptions& box);

    /// Subtracts the box's own depression from the samples of its columns in the last completed
    /// frame.
    void leave_out(HullWater& hull, std::size_t first, std::size_t columns, double tick_s) const;

   private:
    Disturbance pressing(const FloatingBox& box) const;

    std::uint32_t source_;
    double afloat_s_ = 0;
    glm::dvec3 box_m_;       ///< position of the box at the previous press()
    glm::dvec3 pressure_m_;  ///< position of the pressure source
    /// The sources of the next frame, of the last completed frame, which shows the tick before it,
    /// and of that tick.
    std::array<Disturbance, 3> pressures_;
};

}  // namespace pelagic::buoyancy
