// Hulls in regular waves of steepness 1 %: against potential theory, strip theory and closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <utility>

#include "pelagic/floating/hull.hpp"
#include "pelagic/sim/exact_water.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/hull_meshes.hpp"
#include "pelagic/tests/sanitized.hpp"
#include "pelagic/tests/still_water.hpp"

namespace pelagic {
namespace {

struct HeadSeas {
    double heave, pitch;
};

/// Returns amplitudes of heave over the wave's, and of pitch over its slope's, in head seas, without yaw, sway
/// and roll.
/// \param step  step(state, time of its middle, its length)
template <class Step>
HeadSeas head_seas(const Hull& hull, double wavelength_m, int periods, const Step& step) {
    const double k = two_pi / wavelength_m, omega = std::sqrt(gravity_mps2 * k), amplitude_m = 0.005 * wavelength_m;
    constexpr int steps = 80, measured = 4;  // of a period, and periods
    const double step_s = two_pi / omega / steps;
    HullState state = hull.at_rest(0, 0);
    double heave_cosine = 0, heave_sine = 0, pitch_cosine = 0, pitch_sine = 0;
    for (int i = 0; i < steps * periods; ++i) {
        step(state, (i + 0.5) * step_s, step_s);
        state.position_m.z = state.velocity_mps.z = 0;
        state.angular_velocity_radps.x = state.angular_velocity_radps.y = 0;
        state.orientation = glm::normalize(glm::dquat(state.orientation.w, 0, 0, state.orientation.z));
        if (i < steps * (periods - measured)) continue;
        const double phase = k * state.position_m.x - omega * (i + 1) * step_s;
        const double heave = state.position_m.y - hull.afloat().height_m,
                     pitch = glm::mat3_cast(state.orientation)[0].y;
        heave_cosine += heave * std::cos(phase), heave_sine += heave * std::sin(phase);
        pitch_cosine += pitch * std::cos(phase), pitch_sine += pitch * std::sin(phase);
    }
    const double half = steps * measured / 2.0;
    return {std::hypot(heave_cosine, heave_sine) / half / amplitude_m,
            std::hypot(pitch_cosine, pitch_sine) / half / (k * amplitude_m)};
}

/// In the wave's closed form.
HeadSeas head_seas(const Hull& hull, double wavelength_m, int periods = 30) {
    RegularWave water;
    HullWorkspace workspace;
    const double k = two_pi / wavelength_m;
    return head_seas(hull, wavelength_m, periods, [&](HullState& state, double time_s, double step_s) {
        water.set_wave(0.005 * wavelength_m, k, time_s);
        hull.step(water, state, step_s, {}, workspace);
    });
}

/// A sea of one wave.
SeaState sea_of(double wavelength_m) {
    const double period_s = two_pi / std::sqrt(gravity_mps2 * two_pi / wavelength_m);
    SeaState sea{.waves = WaveModel::regular, .regular_height_m = 0.01 * wavelength_m, .regular_period_s = period_s};
    sea.loop_period_s = 60 * period_s;
    sea.resolution = 64;
    return sea;
}

/// In frames of an ocean.
HeadSeas head_seas_in_frames(const Hull& hull, double wavelength_m, int periods = 30) {
    Ocean ocean(sea_of(wavelength_m), {.executor = make_serial_executor(), .queries = true, .depth = true});
    HullWorkspace workspace;
    return head_seas(hull, wavelength_m, periods, [&](HullState& state, double time_s, double step_s) {
        hull.step(WaterQuery(ocean.frame_at(time_s)), state, step_s, {}, workspace);
    });
}

/// In the exact sum over the sea's waves.
HeadSeas head_seas_in_exact_water(const Hull& hull, double wavelength_m, int periods = 30) {
    ExactWater water(sea_of(wavelength_m));
    HullWorkspace workspace;
    return head_seas(hull, wavelength_m, periods, [&](HullState& state, double time_s, double step_s) {
        water.set_time(time_s);
        hull.step(water, state, step_s, {}, workspace);
    });
}

// A spar of 4 m diameter and 20 m draught: Froude and Krylov's force on its bottom, and the added mass of a
// disc of which one side is in the water, 4/3 rho r^3 (Lamb, article 102, halved).
struct Spar {
    static constexpr double radius_m = 2, draught_m = 20;
    static constexpr int sides = 32;
    double area_m2 = sides / 2.0 * radius_m * radius_m * std::sin(two_pi / sides);  // of the polygon
    double mass_kg = 1025 * area_m2 * draught_m, added_kg = 1025 * 4.0 / 3 * radius_m * radius_m * radius_m;

    Hull hull() const {
        HullMatrix added{};
        added[1][1] = added_kg;
        added[0][0] = added[2][2] = mass_kg;
        added[3][3] = added[5][5] = mass_kg * draught_m * draught_m / 12;
        return Hull(cylinder_mesh(radius_m, 24, sides, 12),
                    {.mass_kg = mass_kg, .centre_of_mass_m = glm::dvec3(0, -6, 0), .added_mass = added});
    }
    double heave(double wavelength_m) const {
        const double k = two_pi / wavelength_m, omega2 = gravity_mps2 * k, stiffness = 1025 * gravity_mps2 * area_m2;
        return std::fabs((stiffness - omega2 * added_kg) * std::exp(-k * draught_m) /
                         (stiffness - omega2 * (mass_kg + added_kg)));
    }
};

TEST(HullResponse, ASparHeavesAsFroudeAndKrylovWithAddedMass) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; other tests run the same code";
    const Spar spar;
    const Hull hull = spar.hull();
    // resonance at 130 m, which drag limits
    for (const double wavelength_m : {400.0, 300.0, 200.0, 90.0, 80.0})
        EXPECT_NEAR(head_seas(hull, wavelength_m, 60).heave / spar.heave(wavelength_m), 1, 0.1) << wavelength_m;
    EXPECT_GT(head_seas(hull, 130, 60).heave, 2);
    EXPECT_LT(head_seas(hull, 60, 60).heave, 0.15);
    EXPECT_LT(head_seas(hull, 40, 60).heave, 0.05);
}

TEST(HullResponse, FramesAndExactWaterMoveASparAlike) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; other tests run the same code";
    const Spar spar;
    const Hull hull = spar.hull();
    for (const double wavelength_m : {300.0, 60.0, 40.0}) {
        const double expected = head_seas(hull, wavelength_m, 40).heave;
        EXPECT_NEAR(head_seas_in_frames(hull, wavelength_m, 40).heave, expected,
                    0.02 * expected + 0.005) << wavelength_m;
        EXPECT_NEAR(head_seas_in_exact_water(hull, wavelength_m, 40).heave, expected, 0.02 * expected + 0.005)
            << wavelength_m;
    }
}

// J. J. Jensen, A. E. Mansour and A. S. Olsen, "Estimation of ship motions using closed-form expressions",
// Ocean Engineering 31, 2004: a box without forward speed in head seas.
struct ClosedForm {
    double heave, pitch;
    ClosedForm(double length_m, double beam_m, double draught_m, double wavelength_m) {
        const double k = two_pi / wavelength_m, half = k * length_m / 2, kb = k * beam_m, kt = k * draught_m;
        const double waves = 2 * std::sin(kb / 2) * std::exp(-kt), damping = waves * waves / kb;
        const double force = std::exp(-kt) * std::hypot(1 - kt, damping);
        const double resonance = 1 / std::hypot(1 - 2 * kt, damping);
        heave = std::fabs(resonance * force * std::sin(half) / half);
        pitch = std::fabs(resonance * force * 3 * (std::sin(half) - half * std::cos(half)) / (half * half * half));
    }
};

// A barge of 90 m x 15 m and a draught of 5 m, of 12 and of 1452 triangles.
TEST(HullResponse, ABargeMovesAsJensensClosedForms) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; other tests run the same code";
    const double length_m = 90, beam_m = 15, draught_m = 5;
    const auto barge = [&](int cells) {
        return Hull(box_mesh({length_m, 9, beam_m}, cells), {.mass_kg = 1025 * length_m * beam_m * draught_m});
    };
    const Hull coarse = barge(1), fine = barge(11);
    for (const double ratio : {0.75, 1.0, 1.25, 1.5, 2.0, 4.0, 10.0}) {
        SCOPED_TRACE(ratio);
        const ClosedForm expected(length_m, beam_m, draught_m, ratio * length_m);
        const HeadSeas of_coarse = head_seas(coarse, ratio * length_m, 20), of_fine = head_seas(fine,
                                                                                                ratio * length_m, 20);
        EXPECT_NEAR(of_fine.heave, expected.heave, std::max(0.1 * expected.heave, 0.03));
        EXPECT_NEAR(of_fine.pitch, expected.pitch, 0.25 * expected.pitch);
        EXPECT_NEAR(of_coarse.heave, of_fine.heave, std::max(0.03 * of_fine.heave, 0.02));
        EXPECT_NEAR(of_coarse.pitch, of_fine.pitch, std::max(0.03 * of_fine.pitch, 0.02));
        RecordProperty("heave_" + std::to_string(ratio), std::to_string(of_fine.heave));
    }
}

/// Returns the amplitude of a force along an axis on a hull that is held, over rho g a.
double held_force_m2(const Hull& hull, double wavelength_m, int axis) {
    RegularWave water;
    const double k = two_pi / wavelength_m, omega = std::sqrt(gravity_mps2 * k), amplitude_m = 0.005 * wavelength_m;
    HullWorkspace workspace;
    double cosine = 0, sine = 0;
    constexpr int steps = 48;
    for (int i = 0; i < steps; ++i) {
        const double phase = two_pi * i / steps;
        water.set_wave(amplitude_m, k, phase / omega);
        HullState state = hull.at_rest(0, 0);
        const HullLoads loads = hull.loads(water, state, 1e-3, {}, workspace);
        const double force = (loads.pressure.force_n + loads.added_mass.force_n)[axis];
        cosine += force * std::cos(phase), sine += force * std::sin(phase);
    }
    return std::hypot(cosine, sine) / (steps / 2.0) / (1025 * gravity_mps2 * amplitude_m);
}

// A cylinder of radius a and draught T that stands in deep water. R. C. MacCamy and R. A. Fuchs (1954, Beach
// Erosion Board TM 69) for one that reaches the bottom, integrated down to T: 4 rho g A (1 - e^(-kT)) / k^2 /
// |H1'(ka)|.
TEST(HullResponse, ATruncatedCylinderFeelsMacCamysForce) {
    const double radius_m = 3, draught_m = 18;
    const Hull hull(cylinder_mesh(radius_m, 24, 32, 16),
                    {.mass_kg = 1025 * 16 * radius_m * radius_m * std::sin(two_pi / 32) * draught_m,
                     .centre_of_mass_m = glm::dvec3(0, -6, 0)});
    for (const double ka : {0.1, 0.2, 0.3, 0.45}) {
        const double k = ka / radius_m, wavelength_m = two_pi / k;
        const double j = std::cyl_bessel_j(0, ka) - std::cyl_bessel_j(1, ka) / ka,
                     y = std::cyl_neumann(0, ka) - std::cyl_neumann(1, ka) / ka;
        const double surge = 4 * (1 - std::exp(-k * draught_m)) / (k * k) / std::hypot(j, y);
        EXPECT_NEAR(held_force_m2(hull, wavelength_m, 0) / surge, 1, 0.1) << ka;
    }
    // Capytaine 3.0: radius 3 m, draught 18 m, 8 x 32 x 36 panels, deep water; m^2
    const std::pair<double, double> heave_m2[] = {{0.1, 14.293}, {0.2, 7.236}, {0.3, 3.653}, {0.45, 1.311}};
    for (const auto& [ka, expected] : heave_m2)
        EXPECT_NEAR(held_force_m2(hull, two_pi / (ka / radius_m), 1) / expected, 1, 0.1) << ka;
}

TEST(HullResponse, ABodyAtFortyMetresHardlyFeelsShortWaves) {
    const Hull hull(box_mesh({4, 2, 3}, 2), {.mass_kg = 1025 * 24.0});
    const auto force_at = [&](double depth_m) {
        RegularWave water;
        const double k = two_pi / 30;
        HullWorkspace workspace;
        double largest_n = 0;
        for (int i = 0; i < 32; ++i) {
            water.set_wave(0.15, k, i * two_pi / 32 / std::sqrt(gravity_mps2 * k));
            HullState state;
            state.position_m.y = -depth_m;
            const HullLoads loads = hull.loads(water, state, 1e-3, {}, workspace);
            const glm::dvec3 weight(0, 1025 * 24 * gravity_mps2, 0);
            largest_n = std::max(largest_n, glm::length(loads.pressure.force_n - weight + loads.added_mass.force_n));
        }
        return largest_n;
    };
    EXPECT_LT(force_at(40), 0.02 * force_at(2));
}

}  // namespace
}  // namespace pelagic
