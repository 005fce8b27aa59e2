// Spray and foam of hulls: speeds of Wagner's theory, within the energy and the momentum that the
// hull loses, none from calm hulls, and outward from a planing one.
#include "pelagic/floating/hull_spray.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <stdexcept>
#include <vector>

#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/spray.hpp"
#include "pelagic/tests/hull_energy.hpp"
#include "pelagic/tests/hull_meshes.hpp"
#include "pelagic/tests/hull_states.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/sanitized.hpp"
#include "pelagic/tests/still_water.hpp"

namespace pelagic {
namespace {

glm::dvec3 velocity_of(const SprayEmitter& emitter) {
    return {emitter.velocity_x_mps, emitter.velocity_y_mps, emitter.velocity_z_mps};
}

/// A hull in still water, and the water that it throws.
struct Thrower {
    StillWater water;
    Hull hull;
    HullSpray thrown;
    HullState state;
    FloatingBodies bodies{make_serial_executor()};
    HullWorkspace workspace;

    explicit Thrower(Hull of, const HullSprayOptions& options = {})
        : hull(std::move(of)), thrown(hull, options), state(hull.at_rest(0, 0)) {
        bodies.add(hull, state);
    }

    HullLoads step(double step_s, const HullInputs& inputs = {}) {
        bodies.set_state(1, state);
        bodies.set_inputs(1, inputs);
        bodies.step(water, step_s);
        state = bodies.state(1);
        thrown.update(water.query(), state, bodies.loads(1), step_s, workspace);
        return bodies.loads(1);
    }
    /// Largest kinetic energy and momentum of the thrown water: all droplets have the largest
    /// deviation from their mean velocity.
    double energy_j() const { return sum(1); }
    double momentum_ns() const { return sum(0); }

   private:
    double sum(int energy) const {
        double sum = 0;
        for (std::size_t i = 0; i < thrown.emitters().size(); ++i) {
            const SprayEmitter& emitter = thrown.emitters()[i];
            const double speed = glm::length(velocity_of(emitter)) + emitter.spread_mps;
            sum += thrown.masses_kg()[i] * (energy ? speed * speed / 2 : speed);
        }
        return sum;
    }
};

/// Position of the highest pressure on a wedge that enters at a constant speed, above the still
/// water and over the depth of its edge: similarity solution of R. Zhao and O. Faltinsen, "Water
/// entry of two-dimensional bodies", J. Fluid Mech. 246 (1993), table 1.
struct Entry {
    double deadrise_deg, rise;
};
constexpr Entry water_entries[] = {{10, 0.5556}, {15, 0.5361}, {20, 0.5087}, {25, 0.4709}, {30, 0.4243}};

TEST(HullSpray, OfAWedgeThatFallsHasTheSpeedOfWagnersJets) {
    for (const Entry& entry : water_entries) {
        SCOPED_TRACE(entry.deadrise_deg);
        const double slope = std::tan(entry.deadrise_deg * degree_rad),
                     cosine = std::cos(entry.deadrise_deg * degree_rad);
        Thrower wedge(Hull(wedge_mesh(6, 4, 2 * slope), {.mass_kg = 0.3 * water_kgpm3 * 6 * 4 * slope}),
                      {.clump_kg = 1e-5});
        const double keel_m = wedge.hull.afloat().draught_m + wedge.hull.afloat().height_m;
        constexpr double fall_m = 0.25;
        wedge.state.position_m.y = keel_m + fall_m;
        for (int i = 0; i < 1000 && wedge.thrown.emitters().empty(); ++i) wedge.step(1.0 / 1200);
        ASSERT_FALSE(wedge.thrown.emitters().empty());
        // The fall continues until the hull is as deep as now.
        const double speed = std::sqrt(2 * gravity_mps2 * (keel_m + fall_m - wedge.state.position_m.y));
        const double edge = (1 + entry.rise) * speed / slope;
        for (const SprayEmitter& emitter : wedge.thrown.emitters()) {
            // 1 % for the formula between Wagner's limits, and 3 % that the wedge has slowed down
            EXPECT_NEAR(std::fabs(emitter.velocity_z_mps) / (edge * (1 + cosine)), 1, 0.04);
            EXPECT_NEAR(emitter.velocity_y_mps / (edge * slope * cosine), 1, 0.04);
            EXPECT_NEAR(emitter.velocity_x_mps, 0, 1e-6) << "depths are floats";
            EXPECT_GT(emitter.velocity_z_mps * emitter.z_m, 0) << "outward";
            EXPECT_NEAR(emitter.y_m, 0, 0.02) << "at the waterline";
        }
        // A breeze of 2 m/s throws no droplets of its own.
        Ocean ocean({.resolution = 16, .wind_speed_mps = 2},
                    {.executor = make_serial_executor(), .spray = SprayOptions{}});
        ocean.emit(wedge.thrown.emitters());
        double mean = 0;
        const auto droplets = ocean.frame_at(1e-3).droplets;
        ASSERT_FALSE(droplets.empty());
        for (const SprayDroplet& droplet : droplets)
            mean += std::fabs(droplet.velocity_z_mps) / static_cast<double>(droplets.size());
        // deviations of 30 % of some droplets
        EXPECT_NEAR(mean / (edge * (1 + cosine)), 1, 0.15);
    }
}

TEST(HullSpray, HasLessEnergyAndMomentumThanTheHullLoses) {
    const glm::dvec3 size(4, 1, 2);
    const double mass = 0.4 * water_kgpm3 * 8;
    const glm::dvec3 inertia = mass / 12 * glm::dvec3(5, 20, 17);
    for (const double heel_deg : {-25.0, -5.0, 10.0, 20.0, 40.0}) {
        SCOPED_TRACE(heel_deg);
        Thrower box(Hull(box_mesh(size, 2), {.mass_kg = mass}));
        box.state.position_m.y = 4;
        box.state.velocity_mps = {3, 0, 1};
        box.state.orientation =
            glm::dquat(std::cos(heel_deg * degree_rad / 2), std::sin(heel_deg * degree_rad / 2), 0, 0);
        box.state.angular_velocity_radps = {0.3, 0.2, -0.5};
        const double first = box_energy_j(box.hull, box.state, size, inertia);
        double before = first, thrown = 0;
        for (int i = 0; i < (is_sanitized ? 30 : 180); ++i) {
            const HullState at_start = box.state;
            constexpr double step_s = 1.0 / 60;
            const HullLoads loads = box.step(step_s);
            const double now = box_energy_j(box.hull, box.state, size, inertia);
            ASSERT_LE(box.energy_j(), before - now + 1e-12 * first) << i;
            before = now;
            thrown += box.energy_j();
            // what the water gave to the hull, apart from its buoyancy
            glm::dvec3 impulse = mass * (box.state.velocity_mps - at_start.velocity_mps);
            impulse.y += step_s * mass * gravity_mps2;
            impulse -= step_s * loads.pressure.force_n;
            ASSERT_LE(box.momentum_ns(), glm::length(impulse) + 1e-9) << i;
            ASSERT_LE(box.momentum_ns(), step_s * loads.impact_n * (1 + 1e-12)) << i;
        }
        if (is_sanitized) continue;
        EXPECT_GT(thrown, 0.01 * first);
        EXPECT_LT(thrown, 0.5 * first) << "half of the work of the impact";
    }
}

// Drops are slower than a hull that falls fast enough, so that they may not have half of its energy.
TEST(HullSpray, HasTheMomentumOfTheImpactAtMost) {
    Thrower box(Hull(box_mesh({4, 1, 2}, 2), {.mass_kg = 0.4 * water_kgpm3 * 8}), {.clump_kg = 1e-3});
    box.state.position_m.y = 2;
    box.state.velocity_mps = {0, -95, 0};
    box.state.orientation = glm::dquat(std::cos(10 * degree_rad), std::sin(10 * degree_rad), 0, 0);
    constexpr double step_s = 1.0 / 1200;
    int reached = 0;
    for (int i = 0; i < 60; ++i) {
        const HullLoads loads = box.step(step_s);
        if (box.thrown.emitters().empty()) continue;
        const double limit = step_s * loads.impact_n;
        ASSERT_LE(box.momentum_ns(), limit * (1 + 1e-12)) << i;
        reached += box.momentum_ns() > limit * (1 - 1e-9);
        ASSERT_LE(box.energy_j(), step_s * loads.impact_w / 2 * (1 + 1e-12)) << i;
    }
    EXPECT_GT(reached, 0);
}

// The thrust of a bore of the height h is rho g h^2 / 2 on a metre of the waterline, here both sides
// of a wedge of 6 m. The part of the impact's force is that of its energy which is thrown.
TEST(HullSpray, FoamIsAsHighAsABoreOfTheImpactsThrust) {
    const double slope = std::tan(20 * degree_rad);
    Thrower wedge(Hull(wedge_mesh(6, 4, 2 * slope), {.mass_kg = 0.3 * water_kgpm3 * 6 * 4 * slope}),
                  {.clump_kg = 1e-3});
    wedge.state.position_m.y = wedge.hull.afloat().draught_m + wedge.hull.afloat().height_m + 0.25;
    constexpr double step_s = 1.0 / 1200;
    int compared = 0;
    for (int i = 0; i < 1000 && compared < 20; ++i) {
        const HullLoads loads = wedge.step(step_s);
        if (wedge.thrown.emitters().empty()) continue;
        ASSERT_LT(wedge.momentum_ns(), 0.99 * step_s * loads.impact_n) << "the drops have all of the energy";
        const double thrown = wedge.energy_j() / (step_s * loads.impact_w / 2);
        const double bore_m = std::sqrt(2 * thrown * loads.impact_n / 12 / (water_kgpm3 * gravity_mps2));
        ASSERT_EQ(wedge.thrown.foam().size(), 8u);
        for (const Disturbance& foam : wedge.thrown.foam()) {
            ASSERT_NEAR(foam.height_m / bore_m, 1, 1e-6) << i;
            ASSERT_NEAR(foam.radius_m, 12.0 / 8, 1e-6);
        }
        ++compared;
    }
    EXPECT_EQ(compared, 20);
}

TEST(HullSpray, IsAbsentAtRestInStillWaterAndInSlowMotion) {
    Thrower boat(Hull(boat_mesh(6, 2.2, 1.2), {.mass_kg = 3500}));
    for (int i = 0; i < 120; ++i) {
        if (i == 60) {
            boat.state.position_m.y += 0.05;
            boat.state.velocity_mps = {0.5, 0, 0.2};
        }
        boat.step(1.0 / 60);
        ASSERT_TRUE(boat.thrown.emitters().empty()) << i;
        ASSERT_TRUE(boat.thrown.foam().empty()) << i;
    }
}

/// Returns a boat that is towed for two seconds, with its bow 4 degrees up.
struct TowedSpray {
    double water_kg = 0, highest_foam_m = 0;
    int droplets = 0, forward = 0, outward = 0, ahead_of_amidships = 0;
};
TowedSpray towed(double speed_mps) {
    Thrower boat(Hull(boat_mesh(6, 2.2, 1.2), {.mass_kg = 1500}));
    TowedSpray sum;
    for (int i = 0; i < 120; ++i) {
        boat.state.velocity_mps = {speed_mps, boat.state.velocity_mps.y, 0};
        boat.state.angular_velocity_radps = {};
        boat.state.orientation = glm::dquat(std::cos(2 * degree_rad), 0, 0, std::sin(2 * degree_rad));
        boat.step(1.0 / 60);
        for (std::size_t j = 0; j < boat.thrown.emitters().size(); ++j) {
            const SprayEmitter& emitter = boat.thrown.emitters()[j];
            ++sum.droplets;
            sum.water_kg += boat.thrown.masses_kg()[j];
            sum.forward += emitter.velocity_x_mps > 0;
            sum.outward += emitter.velocity_z_mps * emitter.z_m > 0;
            sum.ahead_of_amidships += emitter.x_m > boat.state.position_m.x;
        }
        for (const Disturbance& foam : boat.thrown.foam()) {
            EXPECT_EQ(foam.mode, Disturbance::Mode::foam);
            sum.highest_foam_m = std::max(sum.highest_foam_m, foam.height_m);
        }
    }
    return sum;
}

TEST(HullSpray, OfAPlaningBoatLeavesForwardAndOutward) {
    const TowedSpray slow = towed(1.5), fast = towed(9);
    // 0.2 and 1.2 in terms of the length Froude number; spray of planing hulls begins at about 0.6.
    EXPECT_EQ(slow.droplets, 0);
    EXPECT_GT(fast.droplets, 100);
    EXPECT_EQ(fast.outward, fast.droplets);
    // the transom retreats, and the sides of the bow advance
    EXPECT_EQ(fast.forward, fast.droplets);
    EXPECT_GT(fast.highest_foam_m, 0.1);
    EXPECT_LT(fast.highest_foam_m, 9 * 9 / (2 * gravity_mps2)) << "the head of the speed";
    RecordProperty("water_kg", std::to_string(fast.water_kg));
}

// A planing boat whose state and spray are restored in another process throws the same water.
TEST(HullSpray, ASavedStateReplaysBitEqual) {
    const auto boat = [] { return Thrower(Hull(boat_mesh(6, 2.2, 1.2), {.mass_kg = 1500})); };
    const auto thrown_in_30_ticks = [](Thrower& of) {
        std::vector<double> numbers;
        for (int tick = 0; tick < 30; ++tick) {
            of.state.velocity_mps.x = 9;
            of.step(1.0 / 60);
            for (const SprayEmitter& emitter : of.thrown.emitters())
                numbers.insert(numbers.end(), {emitter.time_s, emitter.x_m, emitter.y_m, emitter.z_m});
            for (const Disturbance& foam : of.thrown.foam()) numbers.insert(numbers.end(), {foam.x_m, foam.z_m});
        }
        return numbers;
    };
    Thrower here = boat(), there = boat(), with_new_spray = boat();
    thrown_in_30_ticks(here);
    const std::vector<std::uint8_t> saved = here.thrown.save_state();
    there.state = with_new_spray.state = here.state;
    there.thrown.restore_state(saved);
    EXPECT_EQ(there.thrown.save_state(), saved);
    const std::vector<double> expected = thrown_in_30_ticks(here);
    ASSERT_GT(expected.size(), 100u);
    EXPECT_EQ(thrown_in_30_ticks(there), expected);
    EXPECT_NE(thrown_in_30_ticks(with_new_spray), expected) << "the saved numbers matter";
    EXPECT_EQ(message_of([&] { there.thrown.restore_state(std::span(saved).first(7)); }),
              "the saved spray's number of bytes is 7, expected 8");
    EXPECT_EQ(there.thrown.save_state(), here.thrown.save_state());
}

TEST(HullSpray, FoamOfADisturbanceHasNoWaves) {
    for (const DynamicWavesStep step : {DynamicWavesStep::spectral, DynamicWavesStep::verlet}) {
        DynamicWaves waves({.step = step, .resolution = 64, .side_m = 32, .border_m = 4, .foam_height_m = 0.2});
        waves.advance(0);
        waves.add_impulse({.mode = Disturbance::Mode::foam, .radius_m = 4, .height_m = 0.3});
        const DynamicWavesView& view = waves.advance(1.0 / 60);
        // half of the range from 0.2 to 0.4 m, within a byte
        EXPECT_NEAR(sample(view, 0, 0).foam, 0.5, 1.0 / 255);
        EXPECT_EQ(sample(view, 5, 0).foam, 0) << "below the height of foam";
        EXPECT_EQ(view.bounds.height_max_m, 0);
        EXPECT_EQ(view.bounds.height_min_m, 0);
        // it decays as that of waves, by 90 bytes a second
        double time_s = 1.0 / 60;
        for (int i = 0; i < 60; ++i) waves.advance(time_s += 1.0 / 60);
        EXPECT_NEAR(sample(waves.view(), 0, 0).foam, 0.5 - 90.0 / 255, 2.0 / 255);
        // impulses that wait for a tick are saved
        waves.add_impulse({.mode = Disturbance::Mode::foam, .x_m = 3, .radius_m = 2, .height_m = 9});
        waves.advance(time_s);
        const std::vector<std::uint8_t> saved = waves.save_state();
        const std::uint64_t once = hash_of(waves.advance(time_s + 1.0 / 60));
        EXPECT_EQ(sample(waves.view(), 3, 0).foam, 1);
        waves.restore_state(saved);
        EXPECT_EQ(hash_of(waves.advance(time_s + 1.0 / 60)), once);
    }
}

TEST(HullSpray, InvalidInputIsRefusedInOneLine) {
    const Hull hull(box_mesh({4, 1, 2}), {.mass_kg = 1000});
    EXPECT_EQ(check(HullSprayOptions{}), "");
    EXPECT_EQ(check(HullSprayOptions{.max_droplets = 9000}), "max_droplets 9000 is out of range [0, 8192]");
    EXPECT_THROW(HullSpray(hull, {.clump_kg = 0}), std::invalid_argument);
    HullSpray thrown(hull);
    HullWorkspace workspace;
    const StillWater water;
    HullState state = hull.at_rest(0, 0);
    EXPECT_THROW(thrown.update(water.query(), state, {}, -1, workspace), std::invalid_argument);
    state.position_m.x = NAN;
    EXPECT_THROW(thrown.update(water.query(), state, {}, 0.1, workspace), std::invalid_argument);
}

}  // namespace
}  // namespace pelagic
