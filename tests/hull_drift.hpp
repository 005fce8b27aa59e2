// Hulls with wakes in flat water, without thrust or under a tow.
#pragma once

#include <cmath>
#include <numbers>

#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/hull_meshes.hpp"

namespace pelagic {

enum class DriftingHull { boat, spar, barge };

/// A boat of 6 t, a stable spar buoy of 519 t that is 5 m wide and 26 m deep, or a barge of 40 m.
inline Hull hull_of(DriftingHull kind) {
    switch (kind) {
        case DriftingHull::boat: return Hull(boat_mesh(8, 2.6, 1.4), {.mass_kg = 6000});
        case DriftingHull::spar:
            return Hull(cylinder_mesh(2.5, 31, 28, 24),
                        {.mass_kg = 518'891,
                         .centre_of_mass_m = glm::dvec3(0, -5.1, 0),
                         .heave_damping = 0.2});  // its waves would damp it for minutes
        case DriftingHull::barge: return Hull(box_mesh({40, 5, 12}, 4), {.mass_kg = 1e6});
    }
    return Hull(box_mesh({1, 1, 1}), {.mass_kg = 1});
}

/// A hull and its wake in flat water, with a tick a frame.
struct FlatWater {
    Ocean ocean;
    FloatingBodies bodies;
    const Hull& hull;
    double tick_s;
    int tick = 0;
    double grid_away_m = 0;  ///< from the hull

    FlatWater(const Hull& of, const DynamicWavesOptions& waves,
              const std::shared_ptr<Executor>& executor = make_serial_executor(), const WaterFrame& water = {})
        // waves of the wind are lower than 0.01 mm
        : ocean({.resolution = 16, .patch_size_m = 100, .wind_speed_mps = 0.01f},
                {.executor = executor, .queries = true, .depth = true, .dynamic_waves = waves}),
          bodies(make_serial_executor(), &ocean.dynamic_waves()),
          hull(bodies.hull(bodies.add(of, of.at_rest(0, 0)))),
          tick_s(1.0 / waves.ticks_per_s) {
        change([&](HullState& state) { state.position_m.y += water.sea_level_m; });
        ocean.set_water_frame(water);
        ocean.schedule(0);
    }
    FlatWater(DriftingHull kind, int ticks_per_s)
        : FlatWater(hull_of(kind), {.resolution = 128,
                                    .side_m = kind == DriftingHull::barge ? 256.0 : 64.0,
                                    .ticks_per_s = ticks_per_s,
                                    .border_m = kind == DriftingHull::barge ? 48.0 : 12.0}) {}

    const HullState& state() const { return bodies.state(1); }
    const HullWake& wake() const { return *bodies.inputs(1).wake; }
    /// Calls change(state).
    template <class Change>
    void change(Change&& change) {
        HullState changed = state();
        change(changed);
        bodies.set_state(1, changed);
    }

    /// Advances by a tick. Calls hold(state) before the step.
    template <class Hold>
    void advance(Hold&& hold) {
        const Frame& frame = ocean.complete();
        bodies.press(frame, tick_s);
        ocean.dynamic_waves().set_center(state().position_m.x + grid_away_m, state().position_m.z);
        ocean.schedule(++tick * tick_s);
        change(hold);
        bodies.step(frame, tick_s);
    }
    void advance() {
        advance([](HullState&) {});
    }

    double time_s() const { return tick * tick_s; }
    double speed_mps() const { return std::hypot(state().velocity_mps.x, state().velocity_mps.z); }
    double heading_degrees() const {
        const glm::dvec3 ahead = glm::mat3_cast(state().orientation)[0];
        return std::atan2(ahead.z, ahead.x) * 180 / std::numbers::pi;
    }
};

/// Keeps the speed and the heading, without trim and heel.
inline auto tow_at(double x_mps, double z_mps = 0) {
    return [=](HullState& state) {
        state.velocity_mps = {x_mps, state.velocity_mps.y, z_mps};
        state.angular_velocity_radps = {};
        state.orientation = glm::dquat(1, 0, 0, 0);
    };
}

/// Returns the mean of the wake's force along x over the last 10 s of a tow.
inline double towed_force_n(DriftingHull kind, double speed_mps, int ticks_per_s) {
    FlatWater water(kind, ticks_per_s);
    const double towed_s = water.wake().launch_s() + 60;
    double sum = 0;
    int count = 0;
    while (water.time_s() < towed_s + 10) {
        water.advance(tow_at(speed_mps));
        if (water.time_s() < towed_s) continue;
        sum += water.bodies.loads(1).pressure.force_n.x;
        ++count;
    }
    return sum / count;
}

}  // namespace pelagic
