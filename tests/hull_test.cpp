// Hulls, compared with Archimedes' principle, stability, free oscillations, terminal speeds and
// strip theory.
#include "pelagic/floating/hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/hull_energy.hpp"
#include "pelagic/tests/hull_meshes.hpp"
#include "pelagic/tests/hull_states.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/sanitized.hpp"
#include "pelagic/tests/still_water.hpp"

namespace pelagic {
namespace {

constexpr double hull_step_s = 1.0 / 60;

glm::dquat turned(double angle_rad, const glm::dvec3& axis) {
    return glm::dquat(std::cos(angle_rad / 2), std::sin(angle_rad / 2) * axis);
}

void float_in_still_water(const Hull& hull, HullState& state, double seconds) {
    const StillWater water;
    HullWorkspace workspace;
    for (int i = 0; i < seconds / hull_step_s; ++i) hull.step(water.query(), state, hull_step_s, {}, workspace);
}

TEST(Hull, DraughtIsThatOfArchimedes) {
    for (const double share : {0.05, 0.25, 0.5, 0.75, 0.95}) {
        SCOPED_TRACE(share);
        const Hull hull(box_mesh({4, 1, 3}), {.mass_kg = share * water_kgpm3 * 12});
        EXPECT_NEAR(hull.afloat().draught_m, share, 1e-9) << "the box's";
        EXPECT_NEAR(hull.afloat().waterplane_m2, 12, 1e-9);
        HullState state = hull.at_rest(3, 4);
        state.position_m.y += 0.3;
        state.orientation = turned(10 * degree_rad, {0.6, 0, 0.8});
        float_in_still_water(hull, state, is_sanitized ? 1 : 60);
        if (is_sanitized) continue;
        EXPECT_NEAR(state.position_m.y, 0.5 - share, 0.005 * share) << "half a percent";
        EXPECT_NEAR(glm::mat3_cast(state.orientation)[1].y, 1, 1e-6);
    }
    // A wedge of half angle beam / (2 height) at draught T displaces L T^2 beam / (2 height).
    const Hull wedge(wedge_mesh(6, 2, 1.5), {.mass_kg = water_kgpm3 * 6 * 0.64 * 2 / (2 * 1.5)});
    EXPECT_NEAR(wedge.afloat().draught_m, 0.8, 1e-9);
    EXPECT_NEAR(wedge.afloat().waterplane_m2, 6 * 0.8 * 2 / 1.5, 1e-9);
}

TEST(Hull, MetacentricHeightsAreThoseOfTheBox) {
    // GM = KB + I/V - KG: T/2 + B^2 / (12 T) - KG, of any textbook of naval architecture.
    const double draught = 0.4, keel_to_centre = 0.35;
    const Hull hull(box_mesh({5, 1, 2}, 2), {.mass_kg = water_kgpm3 * 5 * 2 * draught,
                                             .centre_of_mass_m = glm::dvec3(0, keel_to_centre - 0.5, 0)});
    EXPECT_NEAR(hull.afloat().roll_gm_m, draught / 2 + 4 / (12 * draught) - keel_to_centre, 1e-9);
    EXPECT_NEAR(hull.afloat().pitch_gm_m, draught / 2 + 25 / (12 * draught) - keel_to_centre, 1e-9);
}

/// Returns the mean of the first two periods of a quantity that starts above 0.
template <class Value>
double period_s(const Hull& hull, HullState state, const Value& value) {
    const StillWater water;
    HullWorkspace workspace;
    std::vector<double> falls;
    double before = value(state);
    for (int i = 1; falls.size() < 3 && i < 20000; ++i) {
        hull.step(water.query(), state, hull_step_s, {}, workspace);
        const double now = value(state);
        if (before > 0 && now <= 0) falls.push_back((i - 1 + before / (before - now)) * hull_step_s);
        before = now;
    }
    return falls.size() < 3 ? 0 : (falls[2] - falls[0]) / 2;
}

TEST(Hull, HeaveRollAndPitchHaveTheirPeriods) {
    HullMatrix added{};
    const double diagonal[] = {300, 5000, 2000, 1500, 4000, 9000};
    for (std::size_t i = 0; i < 6; ++i) added[i][i] = diagonal[i];
    const double mass = water_kgpm3 * 5 * 2 * 0.4;
    const Hull hull(box_mesh({5, 1, 2}, 2), {.mass_kg = mass,
                                             .centre_of_mass_m = glm::dvec3(0, -0.15, 0),
                                             .added_mass = added,
                                             .heave_damping = 0.03,
                                             .roll_damping = 0.03,
                                             .pressure_coefficient = 0,
                                             .suction_coefficient = 0});
    // Amplitudes are small, and damping of 3 % changes periods by 5e-4. Added mass is that at rest,
    // so a few percent remain for its change with the draught.
    const auto expect_period = [&](double measured, double stiffness, double inertia) {
        EXPECT_NEAR(measured / (2 * std::numbers::pi * std::sqrt(inertia / stiffness)), 1, 0.03);
    };
    HullState lifted = hull.at_rest(0, 0);
    lifted.position_m.y += 0.03;
    expect_period(period_s(hull, lifted, [&](const HullState& s) { return s.position_m.y - hull.afloat().height_m; }),
                  water_kgpm3 * gravity_mps2 * 10, mass + 5000);
    HullState heeled = hull.at_rest(0, 0);
    heeled.orientation = turned(3 * degree_rad, {1, 0, 0});
    const double weight = mass * gravity_mps2;
    expect_period(period_s(hull, heeled, [](const HullState& s) { return s.orientation.x; }),
                  weight * hull.afloat().roll_gm_m, mass * (1 + 4) / 12 + 1500);
    HullState trimmed = hull.at_rest(0, 0);
    trimmed.orientation = turned(1 * degree_rad, {0, 0, 1});
    // strips across the length damp pitch by 3 %, too
    expect_period(period_s(hull, trimmed, [](const HullState& s) { return s.orientation.z; }),
                  weight * hull.afloat().pitch_gm_m, mass * (1 + 25) / 12 + 9000);
}

/// A box of height 1 m, whose beam is `factor` times that of GM = 0: (B/H)^2 = 6 s (1 - s), s its
/// density over the water's.
double near_critical_beam(double share, double factor) { return factor * std::sqrt(6 * share * (1 - share)); }

double heel_rad(const HullState& state) {
    return std::acos(std::clamp(glm::mat3_cast(state.orientation)[1].y, -1.0, 1.0));
}

TEST(Hull, WithNegativeMetacentricHeightSettlesAtTheAngleOfLoll) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; other tests run the same code";
    for (const double share : {0.25, 0.5, 0.75}) {
        const double beam = near_critical_beam(share, 0.97), mass = share * water_kgpm3 * 5 * beam;
        const Hull hull(box_mesh({5, 1, beam}), {.mass_kg = mass, .roll_damping = 0.3});
        ASSERT_LT(hull.afloat().roll_gm_m, 0);
        HullState state = hull.at_rest(0, 0);
        state.orientation = turned(1 * degree_rad, {1, 0, 0});
        float_in_still_water(hull, state, 200);
        // Wall-sided formula GZ = sin(heel) (GM + BM/2 tan^2(heel)): zero at tan^2 = -2 GM/BM, as
        // long as neither deck nor bottom crosses the waterline. A twentieth of a degree remains
        // for settling.
        const double bm_m = beam * beam / (12 * share);
        EXPECT_NEAR(heel_rad(state) / degree_rad,
                    std::atan(std::sqrt(-2 * hull.afloat().roll_gm_m / bm_m)) / degree_rad, 0.05)
            << share;
        // 3 % above the critical beam it rights itself.
        const double broad = near_critical_beam(share, 1.03);
        const Hull stable(box_mesh({5, 1, broad}), {.mass_kg = share * water_kgpm3 * 5 * broad});
        state = stable.at_rest(0, 0);
        state.orientation = turned(5 * degree_rad, {1, 0, 0});
        float_in_still_water(stable, state, 200);
        EXPECT_LT(heel_rad(state), 0.1 * degree_rad) << share;
    }
}

TEST(Hull, BallastTurnsABoxThatIsUpsideDown) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; other tests run the same code";
    const Hull hull(box_mesh({4, 2, 2}),
                    {.mass_kg = 0.5 * water_kgpm3 * 16, .centre_of_mass_m = glm::dvec3(0, -0.6, 0)});
    HullState state = hull.at_rest(0, 0);
    state.orientation = turned(175 * degree_rad, {1, 0, 0});
    float_in_still_water(hull, state, 120);
    EXPECT_LT(heel_rad(state), 0.1 * degree_rad);
}

TEST(Hull, TerminalSpeedsBalanceDrag) {
    // Sinking: (m - rho V) g = rho/2 (C_p + C_s) L B v^2, and friction of the sides.
    const glm::dvec3 size(3, 1, 2);
    const Hull heavy(box_mesh(size), {.mass_kg = 2 * water_kgpm3 * 6, .heave_damping = 0});
    HullState state;
    state.position_m.y = -20;
    float_in_still_water(heavy, state, 20);
    const double sides = 2 * size.y * (size.x + size.z);
    EXPECT_NEAR(
        -state.velocity_mps.y,
        std::sqrt(water_kgpm3 * 6 * gravity_mps2 / (0.5 * water_kgpm3 * (1.05 * size.x * size.z + 4e-3 * sides))),
        1e-3);
    // Under way: an engine against the bow, the transom and the friction of bottom and sides.
    const Hull boat(box_mesh({6, 1, 2}), {.mass_kg = water_kgpm3 * 6, .centre_of_mass_m = glm::dvec3(0, -0.3, 0)});
    const StillWater water;
    HullWorkspace workspace;
    HullState under_way = boat.at_rest(0, 0);
    HullInputs inputs;
    inputs.force.force_n = {4000, 0, 0};
    for (int i = 0; i < 60 / hull_step_s; ++i) {
        // at the centre of the drag, so that the boat does not trim
        inputs.force.torque_nm = {};
        under_way.orientation = glm::dquat(1, 0, 0, 0);
        under_way.angular_velocity_radps = {};
        boat.step(water.query(), under_way, hull_step_s, inputs, workspace);
    }
    const double wet_m2 = 6 * 2 + 2 * 6 * 0.5;
    // It still rises and sinks by a millimetre, which changes the wet area.
    EXPECT_NEAR(under_way.velocity_mps.x, std::sqrt(4000 / (0.5 * water_kgpm3 * (1.05 * 2 * 0.5 + 4e-3 * wet_m2))),
                0.02);
}

// Deep under water nothing but drag opposes 5 % of buoyancy: 0.7 of the front and 0.35 of the back, and
// the friction of the sides.
TEST(Hull, RisesFromTheDepthAsFastAsDragAllows) {
    const Hull hull(box_mesh({2, 2, 2}), {.mass_kg = 0.95 * water_kgpm3 * 8});
    const StillWater water;
    HullWorkspace workspace;
    HullState state = hull.at_rest(0, 0);
    state.position_m.y = -40;
    for (double t = 0; t < 15; t += hull_step_s) hull.step(water.query(), state, hull_step_s, {}, workspace);
    EXPECT_LT(state.position_m.y, -15);
    EXPECT_NEAR(state.velocity_mps.y, std::sqrt(2 * 0.05 * 8 * gravity_mps2 / (1.05 * 4 + 4e-3 * 16)), 0.005);
    // It is never faster, and comes to rest afloat.
    double fastest_mps = 0;
    for (double t = 0; t < 180; t += hull_step_s) {  // its waves damp a cube slowly
        hull.step(water.query(), state, hull_step_s, {}, workspace);
        fastest_mps = std::max(fastest_mps, state.velocity_mps.y);
    }
    EXPECT_LT(fastest_mps, 1.37);
    EXPECT_NEAR(state.position_m.y, hull.at_rest(0, 0).position_m.y, 0.02);
}

TEST(Hull, MechanicalEnergyFallsEachStep) {
    const glm::dvec3 size(4, 1, 2);
    const double mass = 0.4 * water_kgpm3 * 8;
    const Hull hull(box_mesh(size, 2), {.mass_kg = mass});
    const glm::dvec3 inertia = mass / 12 * glm::dvec3(5, 20, 17);
    struct Start {
        const char* name;
        double height_m;
        glm::dvec3 velocity, spin;
    };
    for (const Start& start : {Start{"afloat", 0.3, {1, 0, 0.5}, {0.2, 0.1, 0.1}},
                               Start{"thrown from the air", 8, {5, 3, -2}, {1, -2, 0.7}},
                               Start{"submerged", -15, {2, 0, 1}, {-0.5, 0.3, 1}}}) {
        SCOPED_TRACE(start.name);
        const StillWater water;
        HullWorkspace workspace;
        HullState state = hull.at_rest(0, 0);
        state.position_m.y = start.height_m;
        state.velocity_mps = start.velocity;
        state.angular_velocity_radps = start.spin;
        double before = box_energy_j(hull, state, size, inertia);
        const double first = before;
        for (int i = 0; i < (is_sanitized ? 100 : 10000); ++i) {
            hull.step(water.query(), state, hull_step_s, {}, workspace);
            const double now = box_energy_j(hull, state, size, inertia);
            // rounding of the sums of the energy itself
            ASSERT_LE(now, before + 1e-13 * first) << "step " << i;
            before = now;
        }
        if (is_sanitized) continue;
        // The energy of the box at rest remains, of weight and displaced water, within that of a
        // millimetre of lift.
        EXPECT_NEAR(before, box_energy_j(hull, hull.at_rest(0, 0), size, inertia), 1e-3 * mass * gravity_mps2);
    }
}

/// Returns the amplitude of a hull's heave and pitch over those of the water's height and slope in
/// a regular head sea.
struct Response {
    double heave, pitch;
};
Response response(const Hull& hull, double side_m, int waves, double amplitude_m) {
    RegularWave water;
    const double k = two_pi * waves / side_m, omega = std::sqrt(gravity_mps2 * k), period = two_pi / omega;
    constexpr int steps = 400;  // a period
    const double t = period / steps;
    HullWorkspace workspace;
    HullState state = hull.at_rest(0, 0);
    double cosine = 0, sine = 0, pitch_cosine = 0, pitch_sine = 0;
    constexpr int periods = 12;
    for (int i = 0; i < steps * periods; ++i) {
        water.set_wave(amplitude_m, k, (i + 0.5) * t);
        hull.step(water.query(), state, t, {}, workspace);
        if (i < steps * (periods - 4)) continue;
        const double phase = k * state.position_m.x - omega * (i + 1) * t,
                     heave = state.position_m.y - hull.afloat().height_m;
        const double pitch = glm::mat3_cast(state.orientation)[0].y;
        cosine += heave * std::cos(phase), sine += heave * std::sin(phase);
        pitch_cosine += pitch * std::cos(phase), pitch_sine += pitch * std::sin(phase);
    }
    const double samples = steps * 4 / 2;
    return {std::hypot(cosine, sine) / samples / amplitude_m,
            std::hypot(pitch_cosine, pitch_sine) / samples / (k * amplitude_m)};
}

// Strip theory without forward speed (Newman, chapter 6): a strip at x feels, for a wave of height
// eta(x), (rho g B e^(-k T) - omega^2 A + i omega b) eta, A and b its added mass and damping.
TEST(Hull, ResponseToLongWavesIsThatOfStripTheory) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; other tests run the same code";
    const glm::dvec3 size(10, 2, 3);
    const double mass = water_kgpm3 * 30, draught = mass / (water_kgpm3 * size.x * size.z);
    const Hull hull(box_mesh(size, 4),
                    {.mass_kg = mass, .centre_of_mass_m = glm::dvec3(0, -0.2, 0), .heave_damping = 0.2});
    const double heave_a = hull.added_mass()[1][1], pitch_a = hull.added_mass()[5][5];
    const double stiffness = water_kgpm3 * gravity_mps2 * size.z;  // for a metre of length
    const double damping = 2 * 0.2 * std::sqrt(stiffness * size.x * (mass + heave_a)) / size.x;
    for (const double wavelength : {150.0, 300.0, 600.0}) {
        const Response measured = response(hull, 2 * wavelength, 2, wavelength / 200);
        const double k = two_pi / wavelength, omega2 = gravity_mps2 * k, half = k * size.x / 2;
        const std::complex<double> i_omega_b(0, std::sqrt(omega2) * damping);
        const double pressure = stiffness * std::exp(-k * draught);
        const std::complex<double> heave = (pressure * size.x - omega2 * heave_a + i_omega_b * size.x) *
                                           (std::sin(half) / half) /
                                           (stiffness * size.x - omega2 * (mass + heave_a) + i_omega_b * size.x);
        // integral of x sin(k x) / k over the length
        const double lever = 2 * (std::sin(half) - half * std::cos(half)) / (k * k * k);
        const double inertia = mass * (size.x * size.x + size.y * size.y) / 12 + mass * 0.2 * 0.2;
        const double third = size.x * size.x * size.x / 12;
        // the force ahead acts at the middle of the volume, 0.3 m below the centre of mass
        const double ahead = mass * gravity_mps2 * std::exp(-k * draught / 2) * (-draught / 2 + 0.2);
        const std::complex<double> pitch =
            (pressure * lever + ahead - omega2 * pitch_a * lever / third + i_omega_b * lever) /
            (mass * gravity_mps2 * hull.afloat().pitch_gm_m - omega2 * (inertia + pitch_a) + i_omega_b * third);
        EXPECT_NEAR(measured.heave / std::abs(heave), 1, 0.03) << wavelength;
        EXPECT_NEAR(measured.pitch / std::abs(pitch), 1, 0.03) << wavelength;
        if (wavelength < 300) continue;
        EXPECT_NEAR(measured.heave, 1, 0.03) << wavelength;
        EXPECT_NEAR(measured.pitch, 1, 0.03) << wavelength;
    }
}

/// A box in the air, where nothing acts on it but its weight, that turns about all of its axes.
struct TumblingBox {
    static constexpr double mass_kg = 1000;
    glm::dvec3 size_m{4, 1, 2};
    Hull hull{box_mesh(size_m), {.mass_kg = mass_kg, .air_density_kgpm3 = 0}};
    HullState state = hull.at_rest(0, 0);
    StillWater water;
    HullWorkspace workspace;

    explicit TumblingBox(const glm::dvec3& spin_radps) {
        state.position_m.y = 5000;
        state.angular_velocity_radps = spin_radps;
    }
    /// Of an even box (a^2 + b^2) / 12, in the axes of the world.
    glm::dvec3 momentum() const {
        const glm::dvec3 square = size_m * size_m;
        const glm::dvec3 inertia =
            mass_kg / 12 * glm::dvec3(square.y + square.z, square.x + square.z, square.x + square.y);
        const glm::dmat3 axes = glm::mat3_cast(state.orientation);
        return axes * (inertia * (glm::transpose(axes) * state.angular_velocity_radps));
    }
    /// Returns the largest change of the angular momentum in ten seconds, over it.
    double change(double steps_per_s) {
        const glm::dvec3 first = momentum();
        double largest = 0;
        for (int i = 0; i < 10 * steps_per_s; ++i) {
            hull.step(water.query(), state, 1 / steps_per_s, {}, workspace);
            largest = std::max(largest, glm::length(momentum() - first) / glm::length(first));
        }
        return largest;
    }
};

TEST(Hull, ATumblingHullKeepsItsAngularMomentum) {
    // the last one flips over about its middle axis
    for (const glm::dvec3& spin : {glm::dvec3(0.5, 1.2, 2), glm::dvec3(1.5, 3.6, 6), glm::dvec3(0.01, 0.01, 5)})
        EXPECT_LT(TumblingBox(spin).change(60), 0.005);
    const glm::dvec3 spin(1.5, 3.6, 6);
    EXPECT_LT(TumblingBox(spin).change(120), TumblingBox(spin).change(60) / 3) << "of second order: 1/4";
}

// A symmetric top without torque: its axis turns about the angular momentum L at L / I, with the
// moment of inertia I across the axis (L. Landau, E. Lifshitz, Mechanics, section 33).
TEST(Hull, AFreeTopPrecesses) {
    const Hull top(box_mesh({4, 1, 1}),
                   {.mass_kg = 1000, .inertia_kgm2 = glm::dvec3(500, 1500, 1500), .air_density_kgpm3 = 0});
    HullState state = top.at_rest(0, 0);
    state.position_m.y = 5000;
    state.angular_velocity_radps = {4, 1, 0};
    const glm::dvec3 momentum(500 * 4.0, 1500 * 1.0, 0);
    const StillWater water;
    HullWorkspace workspace;
    for (int i = 0; i < 600; ++i) top.step(water.query(), state, hull_step_s, {}, workspace);
    const double angle = glm::length(momentum) / 1500 * 10;
    const glm::dvec3 about = glm::normalize(momentum), start(1, 0, 0), along = glm::dot(start, about) * about;
    const glm::dvec3 expected =
        along + std::cos(angle) * (start - along) + std::sin(angle) * glm::cross(about, start - along);
    // 0.01 rad of 16.7 rad
    EXPECT_LT(glm::length(glm::mat3_cast(state.orientation)[0] - expected), 0.01);
}

/// A hull in still water without drag and damping, and with an added mass in surge alone.
Hull frictionless(double surge_kg) {
    HullMatrix added{};
    added[0][0] = surge_kg;
    return Hull(box_mesh({4, 1, 2}), {.mass_kg = 4000,
                                     .inertia_kgm2 = glm::dvec3(1e9),
                                     .added_mass = added,
                                     .heave_damping = 1e-12,
                                     .roll_damping = 0,
                                     .pressure_coefficient = 0,
                                     .suction_coefficient = 0,
                                     .friction_coefficient = 0,
                                     .air_coefficient = 0});
}

TEST(Hull, AddedMassInSurgeSlowsDownAThrust) {
    const Hull hull = frictionless(1500);
    HullState state = hull.at_rest(0, 0);
    const StillWater water;
    HullWorkspace workspace;
    for (int i = 0; i < 60; ++i)
        hull.step(water.query(), state, hull_step_s, {.force = {.force_n = {1100, 0, 0}}}, workspace);
    EXPECT_NEAR(state.velocity_mps.x, 1100 / 5500.0, 1e-6);
}

// In axes that turn at w about y, with speeds u ahead and s to starboard: m (u' + w s) + A u' = 0
// and m (s' - w u) = 0. So u = u0 cos(q t) and s = u0 w/q sin(q t) with q = w sqrt(m / (m + A)).
TEST(Hull, AddedMassTurnsWithTheHull) {
    const Hull hull = frictionless(1500);
    HullState state = hull.at_rest(0, 0);
    const double w = 0.7, q = w * std::sqrt(4000 / 5500.0);
    state.velocity_mps = {2, 0, 0};
    state.angular_velocity_radps = {0, w, 0};
    const StillWater water;
    HullWorkspace workspace;
    for (int i = 0; i < 300; ++i) hull.step(water.query(), state, hull_step_s, {}, workspace);
    const glm::dvec3 in_hull = glm::transpose(glm::mat3_cast(state.orientation)) * state.velocity_mps;
    EXPECT_NEAR(in_hull.x, 2 * std::cos(q * 5), 1e-3);
    // a rotation from +z towards +x
    EXPECT_NEAR(in_hull.z, 2 * w / q * std::sin(q * 5), 1e-3);
}

TEST(Hull, StiffnessIsTheDerivativeOfThePressure) {
    // a hull without symmetry, at rest and lifted
    const HullMesh mesh = boat_mesh(6, 2.2, 1.2);
    const Hull hull(mesh, {.mass_kg = 3500, .centre_of_mass_m = mesh.centre_m() + glm::dvec3(0.4, 0, 0.1)});
    const StillWater water;
    HullWorkspace workspace;
    for (const double lift_m : {0.0, 0.1}) {
        HullState at = hull.at_rest(0, 0);
        at.position_m.y += lift_m;
        // surge, heave, sway, roll, yaw, pitch
        const auto pressure = [&](std::size_t axis, double by) {
            HullState moved = at;
            glm::dvec3 unit{};
            unit[static_cast<int>(axis % 3)] = 1;
            if (axis < 3)
                moved.position_m += by * unit;
            else
                moved.orientation = turned(by, unit);
            const HullForce force = hull.loads(water.query(), moved, hull_step_s, {}, workspace).pressure;
            return std::array<double, 6>{force.force_n.x,   force.force_n.y,   force.force_n.z,
                                         force.torque_nm.x, force.torque_nm.y, force.torque_nm.z};
        };
        HullState kept = at;
        const HullLoads loads = hull.loads(water.query(), kept, hull_step_s, {}, workspace);
        EXPECT_GT(loads.stiffness[1][1], 1e4);
        for (const std::size_t column : {1, 3, 5}) {
            const double step = 1e-3;
            const auto up = pressure(column, step), down = pressure(column, -step);
            for (const std::size_t row : {1, 3, 5}) {
                const double both = std::sqrt(loads.stiffness[row][row] * loads.stiffness[column][column]);
                EXPECT_NEAR(loads.stiffness[row][column], -(up[row] - down[row]) / (2 * step), 1e-3 * both)
                    << row << column;
            }
        }
    }
}

// A wave abeam: the water at the hull's bottom turns with the change of the wave's slope across the hull.
TEST(Hull, TheWaterTurnsWithTheSlopeOfABeamSea) {
    RegularWave towards_x, towards_z(std::numbers::pi / 2);
    const double k = two_pi * 2 / 64, omega = std::sqrt(gravity_mps2 * k), amplitude = 0.2;
    const Hull hull(box_mesh({4, 1, 2}, 4), {.mass_kg = 4000});
    HullWorkspace workspace;
    for (const double time_s : {0.0, 0.4, 1.1}) {
        // h = a cos(k s - omega t) along s, so dh/ds = -a k sin(k s - omega t), which changes at s = 0
        // by this
        const double change = amplitude * k * omega * std::cos(omega * time_s);
        const auto expect_rotation = [&](auto& water, double heading_rad, const glm::dvec3& expected) {
            water.set_wave(amplitude, k, time_s);
            HullState state = hull.at_rest(0, 0, heading_rad);
            const HullLoads loads = hull.loads(water.query(), state, hull_step_s, {}, workspace);
            // what is left at the bottom, by the depth below the surface there, within the wave's steepness of 0.04
            const double left = std::exp(-k * (hull.afloat().draught_m + amplitude * std::cos(omega * time_s)));
            EXPECT_LT(glm::length(loads.water_rotation_radps - left * expected), 0.04 * amplitude * k * omega)
                << time_s;
            // about the hull's own length it is roll
            const glm::dvec3 ahead = glm::mat3_cast(state.orientation)[0];
            EXPECT_NEAR(std::fabs(glm::dot(loads.water_rotation_radps, ahead)), left * std::fabs(change),
                        0.04 * amplitude * k * omega);
        };
        // a rotation about z lifts points at +x, one about x lowers points at +z
        expect_rotation(towards_x, std::numbers::pi / 2, {0, 0, change});
        expect_rotation(towards_z, 0, {-change, 0, 0});
    }
}

// Towed across at v and ahead at u: the difference of a skeg is 1/2 rho S (1.56 u + 1.17 v) v.
TEST(Hull, ASkegHasTheLiftOfAFin) {
    const HullMesh mesh = boat_mesh(6, 2.2, 1.2);
    const StillWater water;
    HullWorkspace workspace;
    const auto drag = [&](double skeg_m2, double ahead, double across) {
        const Hull hull(mesh, {.mass_kg = 3500, .skeg_m2 = skeg_m2, .skeg_x_m = -2.5});
        HullState state = hull.at_rest(0, 0);
        state.velocity_mps = {ahead, 0, across};
        return hull.loads(water.query(), state, 1e-6, {}, workspace).drag;
    };
    for (const auto& [ahead, across] : {std::pair(4.0, 0.5), {0.0, 1.0}, {-3.0, -0.2}}) {
        const HullForce with = drag(0.3, ahead, across), without = drag(0, ahead, across);
        const double expected =
            -0.5 * 1025 * 0.3 * (1.56 * std::fabs(ahead) + 1.17 * std::fabs(across)) * across;
        EXPECT_NEAR(with.force_n.z - without.force_n.z, expected, 1e-3 * std::fabs(expected));
        const double lever_m = -2.5 - Hull(mesh, {.mass_kg = 3500}).centre_of_mass_m().x;
        EXPECT_NEAR(with.torque_nm.y - without.torque_nm.y, -lever_m * expected, 1e-3 * std::fabs(expected));
    }
}

// A straight thrust, and a small turn at the start. The course of the second half minute.
TEST(Hull, ASkegKeepsTheCourse) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; the test above runs the same code";
    const auto turn_rad = [](double skeg_m2) {
        const Hull hull(boat_mesh(6, 2.2, 1.2), {.mass_kg = 3500, .skeg_m2 = skeg_m2, .skeg_x_m = -2.5});
        const StillWater water;
        HullWorkspace workspace;
        HullState state = hull.at_rest(0, 0);
        state.angular_velocity_radps.y = 0.02;
        double turn = 0;
        for (int i = 0; i < 60 / hull_step_s; ++i) {
            const glm::dvec3 thrust = 3000.0 * glm::mat3_cast(state.orientation)[0];
            hull.step(water.query(), state, hull_step_s, {.force = {.force_n = thrust}}, workspace);
            if (i > 30 / hull_step_s) turn += state.angular_velocity_radps.y * hull_step_s;
        }
        return std::fabs(turn);
    };
    const double without = turn_rad(0), with = turn_rad(0.36);
    RecordProperty("turn_rad", std::to_string(without) + " " + std::to_string(with));
    EXPECT_GT(without, 1) << "the reason for skegs";
    // The triangles of the mesh are not quite those of its mirror image.
    EXPECT_LT(with, 10 * degree_rad);
}

TEST(Hull, AHitchIsDividedIntoSteps) {
    const Hull hull(boat_mesh(6, 2.2, 1.2), {.mass_kg = 3500});
    const StillWater water;
    HullWorkspace workspace;
    const auto thrown = [&] {
        HullState state = hull.at_rest(0, 0);
        state.position_m.y += 1;
        state.velocity_mps = {3, 0, 0};
        return state;
    };
    const auto after = [&](double step_s, int steps, bool expected) {
        HullState state = thrown();
        for (int i = 0; i < steps; ++i)
            EXPECT_EQ(hull.step(water.query(), state, step_s, {}, workspace), expected) << step_s;
        return state;
    };
    EXPECT_TRUE(equal(after(0.35, 1, true), after(0.35 / 4, 4, true)));
    EXPECT_TRUE(equal(after(1, 1, true), after(0.1, 10, true)));
    EXPECT_TRUE(equal(after(20, 1, false), after(1, 1, true))) << "a second at most";
    EXPECT_TRUE(equal(after(0, 3, true), thrown()));
    FloatingBodies bodies(make_serial_executor());
    for (const std::uint32_t number : {1u, 2u}) EXPECT_EQ(bodies.add(hull, thrown()), number);
    EXPECT_FALSE(bodies.step(water.query(), 20));
    EXPECT_TRUE(equal(bodies.state(2), after(1, 1, true)));
    // without time nothing changes, and nothing is divided by it
    HullState state = thrown();
    const HullLoads loads = hull.loads(water.query(), state, 0, {}, workspace);
    EXPECT_EQ(glm::length(loads.slamming.force_n), 0);
    hull.accelerate(state, loads, 0);
    EXPECT_EQ(state.velocity_mps, thrown().velocity_mps);
}

/// Level water that accelerates upwards everywhere.
struct RisingWater : StillWater {
    explicit RisingWater(double up_mps2) : up_mps2_(up_mps2) {}
    Motion motion_at(double, double y_m, double) const override {
        return {.depth_m = -y_m, .head_m = -y_m * up_mps2_ / gravity_mps2, .up_mps2 = up_mps2_};
    }
    double up_mps2_;
};

// Waves break before the surface falls freely, so the water's vertical acceleration is at most g.
TEST(Hull, AccelerationOfTheWaterIsThatOfThePressure) {
    const Hull hull(box_mesh({4, 1, 2}, 2), {.mass_kg = 0.5 * water_kgpm3 * 8});
    HullWorkspace workspace;
    constexpr double step_s = 1.0 / 60, weight_n = 0.5 * water_kgpm3 * 8 * gravity_mps2;
    for (const double wanted : {0.5, -0.5, 40.0, -40.0}) {
        const RisingWater water(wanted * gravity_mps2);
        HullState state = hull.at_rest(0, 0);
        const HullLoads loads = hull.loads(water, state, step_s, {}, workspace);
        EXPECT_NEAR(loads.water_acceleration_mps2.y, std::clamp(wanted, -1.0, 1.0) * gravity_mps2, 1e-5) << wanted;
        EXPECT_NEAR(loads.pressure.force_n.y / weight_n, 1 + wanted, 1e-4) << wanted;
    }
}

TEST(Hull, InvalidInputIsRefusedInOneLineAndChangesNothing) {
    const HullMesh mesh = box_mesh({4, 1, 2});
    EXPECT_EQ(Hull::check(mesh, {.mass_kg = 1000}), "");
    EXPECT_EQ(Hull::check(mesh, {}), "mass_kg 0 is out of range [1e-6, 1e10]");
    EXPECT_EQ(Hull::check(mesh, {.mass_kg = 1000, .centre_of_mass_m = glm::dvec3(0, 3, 0)}),
              "centre_of_mass_m.y is 3, expected a position within the mesh, -0.5 to 0.5");
    HullMatrix lopsided{}, negative{};
    lopsided[0][1] = 3;
    EXPECT_EQ(Hull::check(mesh, {.mass_kg = 1000, .added_mass = lopsided}),
              "added_mass[0][1] is 3, expected 0, a symmetric matrix");
    negative[2][2] = -1;
    EXPECT_NE(Hull::check(mesh, {.mass_kg = 1000, .added_mass = negative}), "");
    EXPECT_THROW(Hull(mesh, {.mass_kg = NAN}), std::invalid_argument);

    const Hull hull(mesh, {.mass_kg = 1000});
    const StillWater water;
    FloatingBodies bodies(make_serial_executor());
    HullState before = hull.at_rest(0, 0);
    before.position_m.y += 1;
    for (int i = 0; i < 4; ++i) bodies.add(hull, before);
    HullState state = before;
    state.velocity_mps.z = NAN;
    EXPECT_EQ(message_of([&] { bodies.set_state(4, state); }),
              "the hull's velocity_mps is out of range [-1e4, 1e4]");
    state = before;
    state.submersion = NAN;
    EXPECT_THROW(bodies.set_state(4, state), std::invalid_argument);
    EXPECT_TRUE(equal(bodies.state(4), before));
    EXPECT_THROW(bodies.set_inputs(3, {.force = {.force_n = {NAN, 0, 0}}}), std::invalid_argument);
    EXPECT_EQ(bodies.inputs(3).force.force_n.x, 0);
    EXPECT_THROW(bodies.step(water.query(), -0.01), std::invalid_argument);
    EXPECT_THROW(bodies.step(water.query(), NAN), std::invalid_argument);
    Ocean without_velocities(rough_sea, {.executor = make_serial_executor(), .queries = true});
    EXPECT_THROW(bodies.step(without_velocities.frame_at(0), hull_step_s), std::invalid_argument);
    EXPECT_TRUE(equal(bodies.state(1), before));
    // A body that leaves the range stops all.
    state = before;
    state.position_m.x = 1e8 - 1;
    state.velocity_mps.x = 1e4;
    bodies.set_state(4, state);
    bodies.step(water.query(), hull_step_s);
    const HullState first = bodies.state(1);
    EXPECT_EQ(message_of([&] { bodies.step(water.query(), hull_step_s); }),
              "body 4: the hull's position_m is out of range [-1e8, 1e8]");
    EXPECT_TRUE(equal(bodies.state(1), first));
}

}  // namespace
}  // namespace pelagic
