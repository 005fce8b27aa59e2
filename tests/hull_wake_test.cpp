// Wakes of hulls: the pressure is the displaced water, a hull at rest keeps its draught, and a
// towed one leaves the waves of Kelvin.
#include "pelagic/floating/hull_wake.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <numeric>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/hull_drift.hpp"
#include "pelagic/tests/hull_energy.hpp"
#include "pelagic/tests/hull_meshes.hpp"
#include "pelagic/tests/hull_states.hpp"
#include "pelagic/tests/kelvin_wake.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;

/// Waves of a millimetre, so that only hulls move the water.
const SeaState still_sea{.resolution = 16, .patch_size_m = 100, .wind_speed_mps = 0.05};

TEST(HullPlan, HoldsTheVolumeOfTheHull) {
    const HullMesh mesh = boat_mesh(6, 2.2, 1.2);
    const HullPlan plan = plan_of(mesh, 24, 9);
    double volume = 0;
    for (std::size_t i = 0; i < plan.low_m.size(); ++i)
        volume += plan.coverage[i] * (plan.high_m[i] - plan.low_m[i]) * plan.length_m * plan.beam_m / (24 * 9);
    // 16 verticals a cell
    EXPECT_NEAR(volume / mesh.volume_m3(), 1, 0.01);
    EXPECT_EQ(*std::min_element(plan.coverage.begin(), plan.coverage.end()), 0) << "beside the bow";
}

/// A hull under a tow.
struct TowedHull : FlatWater {
    double frame_time_s = 0, passed_s = 0;  ///< of the frame in flight, for advance_by()

    TowedHull(const DynamicWavesOptions& waves, HullMesh mesh, const HullOptions& options,
              const WaterFrame& water = {})
        : FlatWater(Hull(std::move(mesh), options), waves, make_thread_executor(2), water) {}

    /// Advances by any time, with the step after the frame that it leads to.
    void advance_by(double frame_s, double speed_mps, double across_mps) {
        const Frame& frame = ocean.complete();
        if (frame_time_s > 0) {
            change(tow_at(speed_mps, across_mps));
            bodies.step(frame, passed_s);
            bodies.press(frame, passed_s);
        }
        ocean.dynamic_waves().set_center(state().position_m.x, state().position_m.z);
        passed_s = frame_s;
        ocean.schedule(frame_time_s += frame_s);
    }

    /// Advances by a tick under a tow that leaves heave and pitch free.
    void tow(double speed_mps) {
        advance([&](HullState& state) {
            state.velocity_mps = {speed_mps, state.velocity_mps.y, 0};
            state.angular_velocity_radps = {0, 0, state.angular_velocity_radps.z};
            state.orientation = glm::angleAxis(trim_rad(), glm::dvec3(0, 0, 1));
        });
    }
    /// Positive: bow up.
    double trim_rad() const { return std::asin(glm::mat3_cast(state().orientation)[0].y); }
};

// Frames of displays that do not follow the ticks of 60 a second, and frames of changing length.
TEST(HullWake, AHullKeepsItsDraughtAtAnyFrameRate) {
    const DynamicWavesOptions waves{.resolution = 128, .side_m = 64, .border_m = 12};
    const WaterFrame water{.current_x_mps = 1.5, .current_z_mps = -0.7};
    // Lengths of frames, s; the last ones change at each frame.
    const std::vector<std::vector<double>> rates = {{1 / 60.},  {1 / 90.}, {1 / 72.},
                                                    {1 / 144.}, {1 / 24.}, {1 / 60., 1 / 20., 1 / 200., 1 / 35.}};
    for (const bool is_towed : {false, true}) {
        double sinkage_of_ticks = 0;
        for (const std::vector<double>& lengths : rates) {
            SCOPED_TRACE("frames of " + std::to_string(lengths[0]) + " s" + (is_towed ? ", towed" : ""));
            TowedHull boat(waves, boat_mesh(8, 2.6, 1.4), {.mass_kg = 6000}, water);
            const double speed_mps = is_towed ? 2.6 : water.current_x_mps, draught = boat.hull.afloat().draught_m;
            double largest = 0, sum = 0, seconds = 0;
            for (std::size_t i = 0; boat.frame_time_s < (is_sanitized ? 1 : 30); ++i) {
                const double frame_s = lengths[i % lengths.size()];
                boat.advance_by(frame_s, speed_mps, water.current_z_mps);
                if (boat.frame_time_s < 24) continue;
                const double sinkage = boat.hull.afloat().height_m - boat.state().position_m.y;
                largest = std::max(largest, std::fabs(sinkage));
                sum += frame_s * sinkage;
                seconds += frame_s;
            }
            if (is_sanitized) continue;  // the pressure has not grown yet
            const double mean = sum / seconds;
            RecordProperty(
                (is_towed ? "towed_" : "rests_") + std::to_string(lengths[0]) + "_" + std::to_string(lengths.size()),
                std::to_string(mean) + " " + std::to_string(largest));
            if (!is_towed) {
                EXPECT_LT(largest, 0.005 * draught);
            }
            if (lengths == rates[0]) sinkage_of_ticks = mean;
            // 0.5 % of the draught, as at rest
            EXPECT_NEAR(mean, sinkage_of_ticks, 0.005 * draught);
        }
    }
}

// At rest, and carried by a current on a high tide.
TEST(HullWake, AHullAtRestKeepsItsDraught) {
    for (const WaterFrame& water :
         {WaterFrame{}, WaterFrame{.sea_level_m = 3, .current_x_mps = 1.5, .current_z_mps = -0.7}}) {
        TowedHull boat({.resolution = 128, .side_m = 64, .border_m = 12}, boat_mesh(8, 2.6, 1.4), {.mass_kg = 6000},
                       water);
        const double draught = boat.hull.afloat().draught_m;
        double largest = 0, largest_volume = 0;
        const int ticks = is_sanitized ? 60 : 30 * 60;
        for (int i = 0; i < ticks; ++i) {
            boat.advance(tow_at(water.current_x_mps, water.current_z_mps));
            if (i < 24 * 60) continue;
            const double height = boat.state().position_m.y - water.sea_level_m;
            largest = std::max(largest, std::fabs(height - boat.hull.afloat().height_m));
            largest_volume = std::max(largest_volume, std::fabs(boat.bodies.loads(1).displaced_m3 * 1025 / 6000 - 1));
        }
        EXPECT_LT(largest, 0.005 * draught);
        RecordProperty("largest_m" + std::to_string(water.sea_level_m), std::to_string(largest));
        if (is_sanitized) return;
        const PressureFootprint& pressed = boat.wake().footprint();
        const double cell_m2 = pressed.length_m * pressed.beam_m / static_cast<double>(pressed.depth_m.size());
        const double volume_m3 = cell_m2 * std::accumulate(pressed.depth_m.begin(), pressed.depth_m.end(), 0.0);
        EXPECT_NEAR(volume_m3 * 1025 / 6000, 1, 0.005) << "its pressure is its weight";
        EXPECT_LT(largest_volume, 0.005);
    }
}

// Without thrust, in flat water.
TEST(HullWake, AHullAtRestStaysWhereItIs) {
    struct Run {
        DriftingHull kind;
        int ticks_per_s;
        double seconds;
    };
    for (const Run& run : {Run{DriftingHull::boat, 60, 120}, Run{DriftingHull::spar, 30, 60}}) {
        // Under a sanitizer only the spar, whose middles of cells come to lie beside texels within 5 s.
        if (is_sanitized && run.kind != DriftingHull::spar) continue;
        FlatWater water(run.kind, run.ticks_per_s);
        while (water.time_s() < (is_sanitized ? 6 : run.seconds)) water.advance();
        // A hand moves a boat faster. Night.HullDrift tests more hulls, for ten minutes.
        EXPECT_LT(water.speed_mps(), 0.002) << water.hull.mass_kg() << " kg";
        EXPECT_LT(std::fabs(water.heading_degrees()), 1) << water.hull.mass_kg() << " kg";
        if (is_sanitized) continue;  // it still heaves
        EXPECT_LT(glm::length(water.state().position_m - water.hull.at_rest(0, 0).position_m), 0.05);
    }
}

TEST(HullWake, HoldsATowedHullBack) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; the tests above run the same code";
    for (const double speed_mps : {0.1, 2.0}) EXPECT_LT(towed_force_n(DriftingHull::boat, speed_mps, 60), 0);
}

// A pressure that does not keep up would push the hull on.
TEST(HullWake, SlowsDownAHullThatCoasts) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; the tests above run the same code";
    FlatWater water(DriftingHull::boat, 60);
    while (water.time_s() < 20) water.advance();
    water.change([](HullState& state) { state.velocity_mps.x = 0.1; });
    double before = 0.1;
    for (double until_s = 30; until_s <= 60; until_s += 10) {
        while (water.time_s() < until_s) water.advance();
        EXPECT_LT(water.state().velocity_mps.x, before);
        before = water.state().velocity_mps.x;
    }
}

// The hollow of a hull that is held at a fraction of a texel, across the texels: without it the
// water is flat, between the texels, too.
TEST(HullWake, LeavesOutTheHollowBetweenTexels) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; the tests above run the same code";
    FlatWater water(DriftingHull::boat, 60);
    const double texel_m = 0.5;
    const HullState held = water.hull.at_rest(0.37 * texel_m, -0.21 * texel_m, 0.6);
    while (water.time_s() < 60) water.advance([&](HullState& state) { state = held; });
    const Frame& frame = water.ocean.complete();
    std::vector<double> x, z;
    for (int i = 0; i < 400; ++i) {
        x.push_back(6 * std::fmod(i * 0.754877, 1.0) - 3);
        z.push_back(6 * std::fmod(i * 0.569840, 1.0) - 3);
    }
    std::vector<float> height(x.size()), velocity(x.size());
    for (std::size_t i = 0; i < x.size(); ++i)
        height[i] = static_cast<float>(sample(frame.dynamic_waves, x[i], z[i]).height_m);
    const double deepest = -*std::min_element(height.begin(), height.end());
    water.wake().leave_out(frame, x, z, height, velocity);
    double largest = 0;
    for (const float left : height) largest = std::max<double>(largest, std::fabs(left));
    EXPECT_GT(deepest, 0.4 * water.hull.afloat().draught_m);
    // waves of the launch; without interpolation it is a tenth of the draught
    EXPECT_LT(largest, 0.005 * water.hull.afloat().draught_m);
}

TEST(HullWake, LeavesOutAndPushesAtOnceAsOneAfterTheOther) {
    FlatWater water(DriftingHull::boat, 60);
    // Launched, and pushed aside: waves and pressure act on each other.
    while (water.time_s() < water.wake().launch_s() * 2)
        water.advance([&](HullState& state) { state.velocity_mps.z = 0.4; });
    const Frame& frame = water.ocean.complete();
    const HullState state = water.state();
    std::vector<double> x, z;
    for (int i = 0; i < 100; ++i) {
        x.push_back(state.position_m.x + 6 * std::fmod(i * 0.754877, 1.0) - 3);
        z.push_back(state.position_m.z + 6 * std::fmod(i * 0.569840, 1.0) - 3);
    }
    std::vector<float> height(x.size()), velocity(x.size());
    std::vector<float> heights = height, velocities = velocity;
    water.wake().leave_out(frame, x, z, height, velocity);
    const HullForce apart = water.wake().push(frame, state);
    const HullForce at_once =
        water.wake().leave_out_and_push(frame, &state, x, z, heights, velocities, {}, {});
    EXPECT_EQ(heights, height);
    EXPECT_EQ(velocities, velocity);
    EXPECT_EQ(at_once.force_n, apart.force_n);
    EXPECT_EQ(at_once.torque_nm, apart.torque_nm);
    EXPECT_NE(apart.force_n.z, 0) << "waves push";
}

// What drives the pressure off the hull, here a current that the grid does not have, ends; then the
// pressure returns by 1 - 1/e in return_s.
TEST(HullWake, ThePressureReturnsToTheHull) {
    FlatWater water(DriftingHull::boat, 60);
    HullWake wake(water.ocean.dynamic_waves(), water.hull, water.state());
    HullLoads loads;
    const auto press = [&](double flow_mps) {
        loads.water_velocity_mps = {flow_mps, 0, 0};
        wake.press(water.ocean.complete(), water.state(), loads, water.tick_s);
        water.ocean.schedule(++water.tick * water.tick_s);
        return wake.footprint();
    };
    // the footprint is that of a tick and a half later
    const auto away_m = [&](const PressureFootprint& of) { return of.x_m - 1.5 * water.tick_s * of.velocity_x_mps; };
    const double middle_m = away_m(press(0));
    double first = 0, last = 0;
    for (int i = 0; i < 60; ++i) first = away_m(press(1)) - middle_m;
    for (int i = 0; i < 60; ++i) last = away_m(press(0)) - middle_m;
    EXPECT_LT(first, -0.5) << "a hull that stands in a flow: its pressure is carried along";
    EXPECT_NEAR(last / first, std::exp(-1 / HullWake::return_s), 0.01);
}

/// Returns the energy of waves of deep water, with heights and vertical velocities at n x n texels of
/// a periodic grid: rho g/2 h^2, and by linear theory rho/2 |w|^2 / k for each wave number k, from a
/// plain Fourier transform.
double wave_energy_j(const std::vector<double>& height_m, std::span<const float> up_mps, std::size_t n,
                     double texel_m) {
    std::vector<std::complex<double>> turns(n), lines(n * n);
    for (std::size_t i = 0; i < n; ++i)
        turns[i] = std::polar(1.0, -2 * pi * static_cast<double>(i) / static_cast<double>(n));
    for (std::size_t row = 0; row < n; ++row)
        for (std::size_t k = 0; k < n; ++k)
            for (std::size_t i = 0; i < n; ++i)
                lines[row * n + k] += static_cast<double>(up_mps[row * n + i]) * turns[i * k % n];
    const auto radpm = [&](std::size_t k) {
        return 2 * pi * static_cast<double>(std::min(k, n - k)) / (static_cast<double>(n) * texel_m);
    };
    double kinetic = 0, potential = 0;
    for (std::size_t l = 0; l < n; ++l)
        for (std::size_t k = 0; k < n; ++k) {
            if (k + l == 0) continue;
            std::complex<double> wave = 0;
            for (std::size_t row = 0; row < n; ++row) wave += lines[row * n + k] * turns[row * l % n];
            kinetic += std::norm(wave) / static_cast<double>(n * n) / std::hypot(radpm(k), radpm(l));
        }
    for (const double height : height_m) potential += height * height;
    return 1025.0 / 2 * (gravity_mps2 * potential + kinetic) * texel_m * texel_m;
}

// A hull that is moved from its rest loses energy to drag and to its waves, and they return no more
// than they took. The surface -d is that of least energy under a pressure rho g d, so the energy of
// the waves is that of the surface above the hull's hollow.
TEST(HullWake, WithoutThrustTheEnergyOfHullAndWavesDoesNotRise) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; the tests above run the same code";
    const glm::dvec3 size(8, 1.4, 2.6);
    constexpr double mass = 6000;
    const glm::dvec3 inertia = mass / 12 * (glm::dvec3(glm::dot(size, size)) - size * size);
    const Hull box(box_mesh(size, 4), {.mass_kg = mass});
    struct Release {
        double speed_mps, rise_mps, heel_rad;
        double rise_limit;  ///< of the energy in a second, as a part of that of the release
    };
    // Waves lose nothing to a hull that they heave, because there is no diffraction: 0.6 %.
    for (const Release& release :
         {Release{0.1, 0, 0, 1e-3}, {0, 0, 0.1, 1e-3}, {0, 0.3, 0, 0.01}, {0, -0.3, 0, 0.01}}) {
        FlatWater water(box, {.resolution = 128, .side_m = 64, .border_m = 12});
        PressureFootprint before;  // of the tick before that of the frame
        const auto advance = [&](double until_s) {
            while (water.time_s() < until_s) {
                before = water.wake().footprint();
                water.advance();
            }
        };
        const auto energy_j = [&] {
            const DynamicWavesView& view = water.ocean.complete().dynamic_waves;
            const auto n = static_cast<std::size_t>(view.resolution);
            std::vector<double> height(n * n);
            for (std::int64_t z = view.first_z; z < view.first_z + view.resolution; ++z)
                for (std::int64_t x = view.first_x; x < view.first_x + view.resolution; ++x) {
                    const std::size_t column = static_cast<std::size_t>(x) & (n - 1),
                                      texel = (static_cast<std::size_t>(z) & (n - 1)) * n + column;
                    const auto depth_m = [&](const PressureFootprint& pressed) {
                        return depth_at(pressed, static_cast<double>(x) * view.texel_m,
                                        static_cast<double>(z) * view.texel_m);
                    };
                    // the hollow of a frame is halfway between two ticks
                    height[texel] = static_cast<double>(view.height_m[texel]) +
                                    (depth_m(water.wake().footprint()) + depth_m(before)) / 2;
                }
            return wave_energy_j(height, view.vertical_velocity_mps, n, view.texel_m) +
                   box_energy_j(box, water.state(), size, inertia) -
                   box_energy_j(box, box.at_rest(0, 0), size, inertia);
        };
        advance(30);  // after the launch
        water.change([&](HullState& state) {
            state.velocity_mps = {release.speed_mps, release.rise_mps, 0};
            state.orientation = glm::angleAxis(release.heel_rad, glm::dvec3(1, 0, 0));
        });
        const double released_j = energy_j();
        double before_j = released_j, largest_rise = -1;
        for (int second = 1; second <= 15; ++second) {
            advance(30 + second);
            const double now_j = energy_j();
            largest_rise = std::max(largest_rise, (now_j - before_j) / released_j);
            before_j = now_j;
        }
        RecordProperty("released_" + std::to_string(release.speed_mps) + "_" + std::to_string(release.rise_mps),
                       std::to_string(released_j) + " J, rises by " + std::to_string(largest_rise));
        EXPECT_LT(largest_rise, release.rise_limit) << release.speed_mps << release.rise_mps;
    }
}

// A grid that does not follow the hull: at its middle, in its border, and away from it.
TEST(HullWake, AHullAtTheEdgeOfTheGridStaysToo) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; the tests above run the same code";
    for (const double away_m : {24.0, 28.0, 32.0, 500.0}) {
        FlatWater water(DriftingHull::boat, 60);
        water.grid_away_m = away_m;
        while (water.time_s() < 40) water.advance();
        EXPECT_LT(water.speed_mps(), 0.01) << away_m;
        EXPECT_NEAR(water.state().position_m.y, water.hull.afloat().height_m, 0.01) << away_m;
    }
}

TEST(HullWake, NoTimeChangesNothingAndATimeOutOfRangeIsRefused) {
    FlatWater water(DriftingHull::boat, 60);
    for (int i = 0; i < 10; ++i) water.advance();
    const Frame& frame = water.ocean.complete();
    const auto press = [&](double tick_s) { water.bodies.press(frame, tick_s); };
    const PressureFootprint before = water.wake().footprint();
    press(0);
    EXPECT_EQ(water.wake().footprint().x_m, before.x_m);
    EXPECT_EQ(water.wake().footprint().velocity_x_mps, before.velocity_x_mps);
    EXPECT_EQ(water.wake().footprint().depth_m, before.depth_m);
    for (const double tick_s : {-0.1, std::nan("")}) EXPECT_THROW(press(tick_s), std::invalid_argument);
    press(3);  // a hitch
    EXPECT_EQ(check(water.wake().footprint()), "");
}

// A launch passes at 4 m/s, 7 m from another launch, which heaves when the wake arrives.
TEST(HullWake, APassingHullMakesAnotherHeave) {
    const Hull launch(boat_mesh(6, 2.5, 1.5), {.mass_kg = 4000});
    const auto heave_of_the_other = [&](bool goes_by) {
        Ocean ocean(still_sea,
                    {.executor = make_serial_executor(),
                     .queries = true,
                     .depth = true,
                     .dynamic_waves = DynamicWavesOptions{.resolution = 128, .side_m = 64, .border_m = 12}});
        FloatingBodies bodies(make_serial_executor(), &ocean.dynamic_waves());
        bodies.add(launch, launch.at_rest(0, 0));
        if (goes_by) bodies.add(launch, launch.at_rest(-16, 7));
        std::vector<double> heave;
        constexpr double tick_s = 1.0 / 60;
        ocean.schedule(0);
        for (int i = 1; i < 14 * 60; ++i) {
            const Frame& frame = ocean.complete();
            bodies.press(frame, tick_s);
            ocean.schedule(i * tick_s);
            bodies.step(frame, tick_s);
            heave.push_back(bodies.state(1).position_m.y);
            if (!goes_by) continue;
            // Towed along +x, after five seconds in which both have come to rest.
            HullState passing = bodies.state(2);
            tow_at(i * tick_s < 5 ? 0 : 4)(passing);
            bodies.set_state(2, passing);
        }
        return heave;
    };
    const std::vector<double> with = heave_of_the_other(true), without = heave_of_the_other(false);
    double before = 0, after = 0;
    for (std::size_t i = 0; i < with.size(); ++i) {
        const double time_s = static_cast<double>(i) / 60, moved = std::fabs(with[i] - without[i]);
        // 7 m beside the boat's track, a wake of 19.47 degrees is 20 m behind the boat. The boat
        // sets out at 5 s, 16 m short of the other hull.
        if (time_s > 4 && time_s < 6) before = std::max(before, moved);
        if (time_s > 9) after = std::max(after, moved);
    }
    RecordProperty("before_m", std::to_string(before));
    RecordProperty("after_m", std::to_string(after));
    EXPECT_GT(after, 0.05);
    EXPECT_LT(before, after / 3);
}

// The edge is measured 6 to 13 wavelengths behind the hull. Nearer, bow and stern waves interfere
// and the highest waves lie inside: at a Froude number of 0.45 the angle is 17.3 degrees over 1.5
// to 6 wavelengths, and 18.2 over 3 to 12.
TEST(HullWake, OfATowedHullHasKelvinsAngleAndLength) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; the test above runs the same code";
    for (const double froude : {0.3, 0.45}) {
        SCOPED_TRACE(froude);
        const double length = 10, speed = froude * std::sqrt(9.80665 * length),
                     wave = 2 * pi * speed * speed / 9.80665;
        const double texel = std::min(length / 12, wave / 10);
        TowedHull boat({.resolution = 512, .side_m = 512 * texel, .ticks_per_s = 20, .border_m = 40 * texel},
                       boat_mesh(length, 3, 2), {.mass_kg = 9000});
        // Waves fall behind at half of the hull's speed, after the pressure has grown.
        const double seconds = 32 * wave / speed + 2 * boat.wake().launch_s();
        for (int i = 0; i < 20 * seconds; ++i) boat.advance(tow_at(speed));
        const DynamicWavesView view = boat.ocean.complete().dynamic_waves;
        const double at = boat.wake().footprint().x_m;
        const auto height = [&](double behind, double aside) { return sample(view, at - behind, aside).height_m; };
        const KelvinWake measured = measure_wake(height, wave, view.texel_m, 6, 13);
        EXPECT_NEAR(measured.length_m, wave, 0.05 * wave);
        for (const double angle : measured.angle_rad) EXPECT_NEAR(angle * 180 / pi, std::asin(1.0 / 3) * 180 / pi, 1);
        const double sinkage = boat.hull.afloat().height_m - boat.state().position_m.y;
        RecordProperty("sinkage_m" + std::to_string(froude), std::to_string(sinkage));
        EXPECT_GT(sinkage, 0) << "a hull sinks into the trough that it makes";
        EXPECT_LT(sinkage, speed * speed / (2 * 9.80665)) << "and by less than the head of its speed";
    }
}

// The lift of a planing flat bottom is C = t^1.1 (0.012 sqrt(l) + 0.0055 l^2.5 / c^2), with the
// trim t in degrees, the wetted length l in beams and the speed coefficient c = v / sqrt(g b) (D.
// Savitsky, "Hydrodynamic design of planing hulls", Marine Technology 1, 1964). A hull that rides
// on its own wave must come near it: its lift is the wave's. At lower speeds the trim is less.
TEST(HullWake, ATowedHullTrimsLikeAPlaningBoat) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; the tests above run the same code";
    constexpr double length = 7, beam = 2.4, mass = 3000, degree = pi / 180;
    for (const double froude : {0.3, 0.45, 0.6, 0.8, 1.0}) {
        SCOPED_TRACE(froude);
        TowedHull boat({.resolution = 256, .side_m = 128, .border_m = 16}, boat_mesh(length, beam, 1.4),
                       {.mass_kg = mass,
                        .centre_of_mass_m = glm::dvec3(-0.8, 0.6, 0),
                        .pressure_coefficient = 0.2,
                        .suction_coefficient = 0.1});
        const double speed = froude * std::sqrt(9.80665 * length);
        double lowest = 90, highest = -90, sum = 0, deepest = 0;
        int count = 0;
        for (int i = 0; i < 60 * 60; ++i) {
            // launched for 9 s, and then faster for 10 s
            boat.tow(speed * std::clamp((i / 60.0 - 9) / 10, 0.0, 1.0));
            if (i < 45 * 60) continue;
            const double trim = boat.trim_rad() / degree;
            lowest = std::min(lowest, trim);
            highest = std::max(highest, trim);
            sum += trim;
            ++count;
            deepest = std::max(deepest, boat.hull.afloat().height_m - boat.state().position_m.y);
        }
        const double c = speed / std::sqrt(9.80665 * beam), l = 0.8 * length / beam,
                     lift = mass * 9.80665 / (0.5 * 1025 * speed * speed * beam * beam),
                     planing = std::pow(lift / (0.012 * std::sqrt(l) + 0.0055 * std::pow(l, 2.5) / (c * c)), 1 / 1.1);
        RecordProperty("trim_" + std::to_string(froude),
                       std::to_string(lowest) + " " + std::to_string(sum / count) + " " + std::to_string(highest) +
                           " planing " + std::to_string(planing) + " sinks " + std::to_string(deepest));
        EXPECT_LT(highest - lowest, 2) << "it does not porpoise";
        EXPECT_LT(highest, planing + 2);
        if (froude >= 0.6) {
            EXPECT_NEAR(sum / count, planing, 1.5);
        }
        EXPECT_LT(deepest, 0.3 * boat.hull.afloat().draught_m);
    }
}

// From a buoy of 2 kg to a ship of 5,000 t, dropped into a storm with dynamic waves: none leaves
// the water for long, and none is faster than a fall from the crests and the water are together:
// crests of 10 m above troughs give 17 m/s, orbital motion 8 m/s.
TEST(HullWake, HullsOfAnySizeStayInAStorm) {
    // On the fronts of waves that lean, the wake of the dropped ship reaches 16 m.
    Ocean ocean({.resolution = 64,
                 .patch_size_m = 400,
                 .wind_speed_mps = 19,
                 .fetch_m = 400e3,
                 .choppiness = 1,
                 .lean = 0},
                {.executor = make_thread_executor(2),
                 .queries = true,
                 .depth = true,
                 .dynamic_waves = DynamicWavesOptions{.resolution = 256, .side_m = 256, .border_m = 24}});
    const Hull kinds[] = {
        Hull(box_mesh({0.3, 0.2, 0.2}), {.mass_kg = 2}), Hull(boat_mesh(4, 1.6, 0.8), {.mass_kg = 350}),
        Hull(boat_mesh(12, 4, 2.5), {.mass_kg = 14e3}), Hull(box_mesh({90, 12, 14}, 4), {.mass_kg = 5e6})};
    FloatingBodies bodies(make_thread_executor(2), &ocean.dynamic_waves());
    for (int i = 0; i < 7; ++i) {
        const Hull& hull = kinds[i % 4];
        HullState state = hull.at_rest(60.0 * (i % 4) - 90, 50.0 * (i / 4) - 25, i);
        state.position_m.y += i < 4 ? 0 : 6;
        state.angular_velocity_radps = {0.5, -0.3, 0.2};
        bodies.add(hull, state);
    }
    constexpr double tick_s = 1.0 / 60;
    double fastest = 0, largest_wave = 0;
    ocean.schedule(0);
    for (int i = 1; i <= (is_sanitized ? 60 : 3600); ++i) {
        const Frame& frame = ocean.complete();
        bodies.press(frame, tick_s);
        ocean.schedule(i * tick_s);
        bodies.step(frame, tick_s);
        largest_wave = std::max<double>(
            {largest_wave, frame.dynamic_waves.bounds.height_max_m, -frame.dynamic_waves.bounds.height_min_m});
        for (std::uint32_t number = 1; number <= 7; ++number) {
            const HullState& state = bodies.state(number);
            const double speed = glm::length(state.velocity_mps);
            fastest = std::max(fastest, speed);
            ASSERT_TRUE(std::isfinite(speed));
            ASSERT_LT(speed, 25) << i << ", " << bodies.hull(number).mass_kg() << " kg";
            ASSERT_LT(std::fabs(state.position_m.y), 20) << i << ", " << bodies.hull(number).mass_kg() << " kg";
            ASSERT_NEAR(glm::dot(state.orientation, state.orientation), 1, 1e-9);
        }
    }
    EXPECT_LT(largest_wave, 14) << "no hollow is deeper than the deepest hull is high";
    RecordProperty("fastest_mps", std::to_string(fastest));
    RecordProperty("largest_wave_m", std::to_string(largest_wave));
}

// Two seas with the same ticks and commands: the second is restored from the first after 30 ticks.
TEST(HullWake, FootprintsAreSavedAndRestored) {
    const DynamicWavesOptions options{.resolution = 64, .side_m = 32, .border_m = 4};
    PressureFootprint footprint{.x_m = 3,
                                .z_m = -1,
                                .forward_x = 0.6,
                                .forward_z = 0.8,
                                .velocity_x_mps = 2,
                                .length_m = 6,
                                .beam_m = 2,
                                .columns = 5,
                                .rows = 2,
                                .depth_m = {0.1f, 0.5f, 0.6f, 0.5f, 0.2f, 0.1f, 0.5f, 0.7f, 0.5f, 0.2f}};
    DynamicWaves first(options), second(options);
    first.add_footprint(footprint);
    first.add_source({.radius_m = 2, .height_m = 0.1});
    for (int i = 0; i < 30; ++i) first.advance(i / 60.0);
    const std::vector<std::uint8_t> saved = first.save_state();
    second.restore_state(saved);
    for (int i = 30; i < 60; ++i) EXPECT_EQ(hash_of(first.advance(i / 60.0)), hash_of(second.advance(i / 60.0))) << i;
    first.restore_state(saved);
    for (int i = 30; i < 60; ++i) first.advance(i / 60.0);
    EXPECT_EQ(hash_of(first.view()), hash_of(second.view()));
    // A damaged state changes nothing. The header begins with counts of sources.
    for (std::size_t cut = 1; cut < 300; cut += 7)
        EXPECT_THROW(second.restore_state(std::span(saved).first(saved.size() - cut)), std::invalid_argument) << cut;
    EXPECT_EQ(hash_of(first.advance(1.1)), hash_of(second.advance(1.1)));
}

// Of a hull that an application moves itself, by copies of its state and wake.
TEST(HullWake, AnUnusableFootprintIsRefused) {
    DynamicWaves waves({.resolution = 64, .side_m = 32, .border_m = 4});
    PressureFootprint footprint{.columns = 2, .rows = 2, .depth_m = {0, 0, 0, 0}};
    EXPECT_EQ(check(footprint), "");
    footprint.depth_m[2] = -1;
    EXPECT_EQ(check(footprint), "depth_m -1 is out of range [0, 100] m");
    footprint.depth_m = {0};
    EXPECT_EQ(check(footprint), "depth_m's size is 1, expected columns x rows, 4");
    EXPECT_THROW(waves.add_footprint(footprint), std::invalid_argument);
    EXPECT_NE(check({.forward_x = 2, .columns = 1, .rows = 1, .depth_m = {0}}), "");
    EXPECT_EQ(check(PressureFootprint{}), "columns 0 is out of range [1, 64]");
}

}  // namespace
}  // namespace pelagic
