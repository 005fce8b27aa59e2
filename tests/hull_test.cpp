// Hulls, compared with Archimedes' principle, stability, free oscillations, terminal speeds and
// strip theory.
#include "pelagic/floating/hull.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/floating/floating_hulls.hpp"
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
    RegularWave water(128, side_m);
    const double k = two_pi * waves / side_m, omega = std::sqrt(gravity_mps2 * k), period = two_pi / omega;
    constexpr int steps = 400;  // a period
    const double t = period / steps;
    HullWorkspace workspace;
    HullState state = hull.at_rest(0, 0);
    double cosine = 0, sine = 0, pitch_cosine = 0, pitch_sine = 0;
    constexpr int periods = 12;
    for (int i = 0; i < steps * periods; ++i) {
        water.set_wave(amplitude_m, waves, (i + 0.5) * t);
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
    const Hull hull(box_mesh(size, 4), {.mass_kg = mass, .centre_of_mass_m = glm::dvec3(0, -0.2, 0)});
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
        const std::complex<double> pitch =
            (pressure * lever - omega2 * pitch_a * lever / third + i_omega_b * lever) /
            (mass * gravity_mps2 * hull.afloat().pitch_gm_m - omega2 * (inertia + pitch_a) + i_omega_b * third);
        EXPECT_NEAR(measured.heave / std::abs(heave), 1, 0.03) << wavelength;
        EXPECT_NEAR(measured.pitch / std::abs(pitch), 1, 0.03) << wavelength;
        if (wavelength < 300) continue;
        EXPECT_NEAR(measured.heave, 1, 0.03) << wavelength;
        EXPECT_NEAR(measured.pitch, 1, 0.03) << wavelength;
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
    FloatingHulls jobs(make_serial_executor());
    std::vector<FloatingHull> hulls(4, {.hull = &hull, .state = hull.at_rest(0, 0)});
    for (FloatingHull& floating : hulls) floating.state.position_m.y += 1;
    hulls[3].state.velocity_mps.z = NAN;
    const HullState before = hulls[0].state;
    EXPECT_EQ(message_of([&] { jobs.step(water.query(), hulls, hull_step_s); }),
              "hull 3: the hull's velocity_mps is out of range [-1e4, 1e4]");
    EXPECT_TRUE(equal(hulls[0].state, before));
    hulls[3].state.velocity_mps.z = 0;
    hulls[2].inputs.force.force_n.x = NAN;
    EXPECT_THROW(jobs.step(water.query(), hulls, hull_step_s), std::invalid_argument);
    EXPECT_TRUE(equal(hulls[0].state, before));
    hulls[2].inputs = {};
    hulls[1].state.submersion = NAN;
    EXPECT_THROW(jobs.step(water.query(), hulls, hull_step_s), std::invalid_argument);
    EXPECT_TRUE(equal(hulls[0].state, before));
    hulls[1].state.submersion = 1;
    EXPECT_THROW(jobs.step(water.query(), hulls, 0), std::invalid_argument);
    EXPECT_THROW(jobs.step(water.query(), hulls, 1), std::invalid_argument);
    EXPECT_TRUE(equal(hulls[0].state, before));
    Ocean without_velocities(rough_sea, {.executor = make_serial_executor(), .queries = true});
    EXPECT_THROW(jobs.step(SurfaceQuery(without_velocities.frame_at(0)), hulls, hull_step_s), std::invalid_argument);
    EXPECT_TRUE(equal(hulls[0].state, before));
}

}  // namespace
}  // namespace pelagic
