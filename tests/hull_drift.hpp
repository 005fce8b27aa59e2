// Hulls with wakes in flat water, without thrust or under a tow.
#pragma once

#include <cmath>
#include <numbers>

#include "pelagic/floating/floating_hulls.hpp"
#include "pelagic/floating/hull_wake.hpp"
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
                        {.mass_kg = 518'891, .centre_of_mass_m = glm::dvec3(0, -5.1, 0)});
        case DriftingHull::barge: return Hull(box_mesh({40, 5, 12}, 4), {.mass_kg = 1e6});
    }
    return Hull(box_mesh({1, 1, 1}), {.mass_kg = 1});
}

/// A hull and its wake, with a tick a frame.
struct FlatWater {
    Hull hull;
    Ocean ocean;
    FloatingHull floating;
    HullWake wake;
    FloatingHulls hulls{make_serial_executor()};
    double tick_s;
    int tick = 0;
    double grid_away_m = 0;  ///< from the hull

    FlatWater(DriftingHull kind, int ticks_per_s)
        : hull(hull_of(kind)),
          // waves of the wind are lower than 0.01 mm
          ocean({.resolution = 16, .patch_size_m = 100, .wind_speed_mps = 0.01f},
                {.executor = make_serial_executor(),
                 .queries = true,
                 .velocities = true,
                 .dynamic_waves =
                     DynamicWavesOptions{.resolution = 128,
                                         .side_m = kind == DriftingHull::barge ? 256.0 : 64.0,
                                         .ticks_per_s = ticks_per_s,
                                         .border_m = kind == DriftingHull::barge ? 48.0 : 12.0}}),
          floating{.hull = &hull, .state = hull.at_rest(0, 0)},
          wake(ocean.dynamic_waves(), hull, floating.state),
          tick_s(1.0 / ticks_per_s) {
        floating.inputs.wake = &wake;
        ocean.schedule(0);
    }

    /// \param tow_mps  not 0: the speed is kept, and the heading, without trim and heel
    void advance(double tow_mps = 0) {
        const Frame& frame = ocean.complete();
        HullState& state = floating.state;
        wake.press(frame, state, floating.loads, tick_s);
        ocean.dynamic_waves().set_center(state.position_m.x + grid_away_m, state.position_m.z);
        ocean.schedule(++tick * tick_s);
        if (tow_mps != 0) {
            state.velocity_mps = {tow_mps, state.velocity_mps.y, 0};
            state.angular_velocity_radps = {};
            state.orientation = glm::dquat(1, 0, 0, 0);
        }
        hulls.step(SurfaceQuery(frame), {&floating, 1}, tick_s);
    }

    double time_s() const { return tick * tick_s; }
    double speed_mps() const { return std::hypot(floating.state.velocity_mps.x, floating.state.velocity_mps.z); }
    double heading_degrees() const {
        const glm::dvec3 ahead = glm::mat3_cast(floating.state.orientation)[0];
        return std::atan2(ahead.z, ahead.x) * 180 / std::numbers::pi;
    }
};

/// Returns the mean of the wake's force along x over the last 10 s of a tow.
inline double towed_force_n(DriftingHull kind, double speed_mps, int ticks_per_s) {
    FlatWater water(kind, ticks_per_s);
    const double towed_s = water.wake.launch_s() + 60;
    double sum = 0;
    int count = 0;
    while (water.time_s() < towed_s + 10) {
        water.advance(speed_mps);
        if (water.time_s() < towed_s) continue;
        sum += water.floating.loads.pressure.force_n.x;
        ++count;
    }
    return sum / count;
}

}  // namespace pelagic
