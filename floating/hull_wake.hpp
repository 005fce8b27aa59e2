// Coupling of a hull with dynamic waves: the water that the hull displaces is the pressure that
// makes its wake.
//
// FloatingBodies has a wake for each body. An application with a physics engine, which moves its
// hulls itself, makes them:
//
//   HullWake wake(waves, hull, state);                       // waves: ocean.dynamic_waves()
//   const Frame& frame = ocean.complete();
//   wake.press(frame, state, loads, tick_s);
//   ocean.schedule(frame.time_s + tick_s);
//   loads = hull.loads(WaterQuery(frame), state, tick_s, {.wake = &wake}, workspace);
//
// The loads of a hull leave out the hollow that its own pressure makes at rest, because that
// pressure is its buoyancy. Waves that it radiated earlier stay, for itself and for others.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/floating/hull.hpp"
#include "pelagic/floating/hull_plan.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/pressure_footprint.hpp"

namespace pelagic {

/// A copy keeps the state for a rollback: assign it after DynamicWaves::restore_state().
class HullWake {
   public:
    /// Time constant with which the pressure returns to the hull. Wind waves carry the hull, but
    /// not the grid, so the pressure follows the hull's motion relative to the water. With smaller
    /// values it makes waves as the water oscillates; with larger ones its hollow is seen beside
    /// the hull.
    static constexpr double return_s = 1;

    /// Adds a pressure to the waves. It grows from zero to the hull's weight, or
    /// less for a hull deeper than half of its beam or length, within launch_s().
    /// \pre both outlive this object
    HullWake(DynamicWaves& waves, const Hull& hull, const HullState& state);

    /// Moves the pressure to the hull. Its shape follows the submerged hull within four periods of
    /// waves of the hull's length. Its weight is at most that of the displaced water and of the
    /// hull. Call it once a frame, between complete() and schedule(), before or after the hull's
    /// step. Until the next call the pressure moves on.
    /// \param frame   the frame completed last; frames may be any time apart
    /// \param state   of the hull at the frame's time
    /// \param loads   of the hull's last step
    /// \param tick_s  time since the last call; 0 changes nothing
    /// \throws std::invalid_argument  if tick_s is negative or not finite
    void press(const Frame& frame, const HullState& state, const HullLoads& loads, double tick_s);

    /// Moves hull and pressure, after a shift of the world's origin: see FloatingBodies::shift().
    void shift(double x_m, double z_m);

    /// Checks the time of a step. \throws std::invalid_argument  what press() throws
    static void check_tick(double tick_s);

    /// Returns four periods of waves with the hull's length. A change of this duration makes hardly
    /// any waves.
    double launch_s() const;

    /// Removes the hull's own hollow from samples of the last completed frame, and replaces the
    /// dynamic waves at the hull by those at its pressure. Where the two are apart, the hull would
    /// otherwise slide down the wave that its moving pressure pushes ahead, and push it on.
    /// \param wake_m       if not empty, receives the height of dynamic waves in the results
    /// \param wake_up_mps  if not empty, receives their vertical velocity in the results
    /// \throws std::invalid_argument  if the spans differ in length
    void leave_out(const Frame& frame, std::span<const double> x, std::span<const double> z,
                   std::span<float> height_m, std::span<float> velocity_y_mps,
                   std::span<double> wake_m = {}, std::span<double> wake_up_mps = {}) const;

    /// Returns the horizontal force of the last completed frame's dynamic waves on the pressure, and
    /// its torque about the vertical through the hull's centre of mass: rho g times the integral of
    /// h grad d, over the texels on which the depth d acts. It is the adjoint of how a moving pressure
    /// makes waves, so that a hull that moves along the surface gains no energy from its own wake.
    /// Heights at the vertices of a mesh, whose edges are longer than short waves, could drive it.
    HullForce push(const Frame& frame, const HullState& state) const;

    /// Calls leave_out() and push(), which share most of their work.
    /// \param state  for push(); null: without it
    /// \returns the result of push(), or 0
    /// \throws std::invalid_argument  as leave_out()
    HullForce leave_out_and_push(const Frame& frame, const HullState* state, std::span<const double> x,
                                 std::span<const double> z, std::span<float> height_m,
                                 std::span<float> velocity_y_mps, std::span<double> wake_m,
                                 std::span<double> wake_up_mps) const;

    /// Returns the pressure of the next tick.
    const PressureFootprint& footprint() const { return next_; }

   private:
    friend class FloatingBodies;
    /// Computes the plan, which is that of all hulls of a kind. launch() adds the pressure.
    HullWake(DynamicWaves& waves, const Hull& hull);
    void launch(const HullState& state);
    double period_s() const;  // of waves of the hull's length
    double shape_s() const;
    double launched_at(double afloat_s) const;

    /// From the centre of mass to the middle of the plan, in world axes.
    glm::dvec3 middle_of_plan_m(const HullState& state) const;
    struct FrameTick {
        std::int64_t tick;  ///< the last one at a frame's time
        double fraction;    ///< of a tick, since then
    };
    FrameTick tick_of(double time_s) const;
    struct ActingFootprint {
        const PressureFootprint* footprint;
        double moved_s;  ///< for which it has moved at its velocity
        /// Copies the moved footprint.
        void copy_to(PressureFootprint& moved) const;
    };
    ActingFootprint acting_at(std::int64_t tick, std::int64_t now) const;
    void keep_acted(std::int64_t tick);
    void shape(PressureFootprint& footprint, const HullState& state, const HullLoads& loads, double tick_s);
    struct Hollow;
    class HollowSampler;
    HullForce push(const Hollow& hollow, HollowSampler& without_hollow, const HullState& state) const;

    DynamicWaves* waves_;
    const Hull* hull_;
    HullPlan plan_;
    std::uint32_t source_ = 0;
    double afloat_s_ = 0;
    glm::dvec3 hull_m_{};                     // position of the hull at the previous press()
    glm::dvec3 pressure_m_{};                 // position of the pressure
    std::int64_t tick_ = 0;                   // of the frame of the last press()
    PressureFootprint next_;                  // of the ticks after it
    std::array<PressureFootprint, 3> acted_;  // of its tick, and of the two before it
    std::vector<float> depth_before_m_;       // scratch memory
};

}  // namespace pelagic
