// Hulls with coefficients of a panel method, and default ones, in waves: compared with the panel method's motions.
#include "pelagic/floating/given_coefficients.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/floating/lewis_sections.hpp"
#include "pelagic/floating/radiation_states.hpp"
#include "pelagic/sim/exact_water.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/hull_energy.hpp"
#include "pelagic/tests/hull_states.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/potential_flow.hpp"
#include "pelagic/tests/potential_flow_bodies.hpp"
#include "pelagic/tests/sanitized.hpp"
#include "pelagic/tests/still_water.hpp"

namespace pelagic {
namespace {

std::string hemisphere_1() { return text_of_source("tests/potential_flow/hemisphere.1"); }
std::string hemisphere_3() { return text_of_source("tests/potential_flow/hemisphere.3"); }

HullOptions hemisphere_options() {
    const double mass_kg = 1025 * hemisphere_body().mesh.volume_m3() / 2;
    return {.mass_kg = mass_kg, .centre_of_mass_m = glm::dvec3(0), .inertia_kgm2 = glm::dvec3(mass_kg / 4)};
}

Hull hemisphere() { return Hull(hemisphere_body().mesh, hemisphere_options()); }

Hull given_hemisphere(bool has_forces) {
    HullOptions options = hemisphere_options();
    const std::string radiation = hemisphere_1(), excitation = has_forces ? hemisphere_3() : "";
    options.coefficients = read_coefficients(hemisphere(), {.radiation = radiation, .excitation = excitation});
    return Hull(hemisphere_body().mesh, options);
}

/// Keeps what potential theory leaves free: a sphere's rotations have no restoring moment.
void hold_rotations(HullState& state) {
    state.angular_velocity_radps = {};
    state.orientation = {1, 0, 0, 0};
}

/// Returns heave over the amplitude of a wave of steepness 1 % towards the heading, in the wave's closed form.
double heave_in_waves(const Hull& hull, double k, double heading_rad = 0) {
    const double omega = std::sqrt(gravity_mps2 * k), amplitude_m = 0.005 * two_pi / k;
    constexpr int steps = 80, periods = 24, measured = 4;
    const double step_s = two_pi / omega / steps;
    const WaveComponent wave{amplitude_m, k * std::cos(heading_rad), k * std::sin(heading_rad), omega, 0};
    std::optional<WaveForces> forces;
    HullInputs inputs;
    if (hull.diffraction()) inputs.diffraction = &forces.emplace(*hull.diffraction(), std::span(&wave, 1), 1);
    RegularWave water(heading_rad);
    HullWorkspace workspace;
    HullState state = hull.at_rest(0, 0);
    std::complex<double> heave = 0;
    for (int i = 0; i < steps * periods; ++i) {
        water.set_wave(amplitude_m, k, (i + 0.5) * step_s);
        hull.step(water, state, step_s, inputs, workspace);
        hold_rotations(state);
        if (i < steps * (periods - measured)) continue;
        const double phase = wave.kx_radpm * state.position_m.x + wave.kz_radpm * state.position_m.z -
                             omega * (i + 1) * step_s;
        heave += (state.position_m.y - hull.afloat().height_m) * std::polar(2.0 / (steps * measured), phase);
    }
    return std::abs(heave) / amplitude_m;
}

// Motions of Capytaine, which Havelock (1955) and Hulme (1982) have in closed form.
TEST(GivenCoefficients, AHemisphereHeavesAsByThePanelMethod) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; other tests run the same code";
    const Hull hull = given_hemisphere(true);
    for (const TruthRow& row : truths_of("hemisphere")) {
        const double ka = row["wave_number_radpm"];
        if (row.is_limit() || ka < 0.1 || ka > 2) continue;
        const double expected = std::abs(row.complex("heave")), heave = heave_in_waves(hull, ka);
        EXPECT_NEAR(heave / expected, 1, 0.1) << ka;
        RecordProperty("heave_" + std::to_string(ka), std::to_string(heave / expected));
    }
}

// The pressure of undisturbed waves and relative motion stand for diffraction while waves are long (Newman, 6.18).
TEST(GivenCoefficients, RadiationAloneServesLongWaves) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; other tests run the same code";
    const Hull hull = given_hemisphere(false);
    for (const TruthRow& row : truths_of("hemisphere")) {
        const double ka = row["wave_number_radpm"];
        if (row.is_limit() || ka < 0.1 || ka > 0.7) continue;
        EXPECT_NEAR(heave_in_waves(hull, ka) / std::abs(row.complex("heave")), 1, 0.1) << ka;
    }
}

TEST(GivenCoefficients, ADefaultHemisphereHeavesInLongWaves) {
    if (is_sanitized) GTEST_SKIP() << "takes minutes; other tests run the same code";
    const Hull hull = hemisphere();
    for (const TruthRow& row : truths_of("hemisphere")) {
        const double ka = row["wave_number_radpm"];
        if (row.is_limit() || ka < 0.1 || ka > 2) continue;
        const double ratio = heave_in_waves(hull, ka) / std::abs(row.complex("heave"));
        RecordProperty("heave_" + std::to_string(ka), std::to_string(ratio));
        if (ka <= 1.01) EXPECT_NEAR(ratio, 1, ka < 0.71 ? 0.2 : 0.35) << ka;
    }
}

// Resonance where omega^2 (m + A) is the stiffness, between the rows of the panel method.
TEST(GivenCoefficients, ThePeriodOfHeaveIsThatOfTheAddedMassThere) {
    const Hull hull = given_hemisphere(false);
    const double stiffness_npm = 1025 * gravity_mps2 * hull.afloat().waterplane_m2;
    double k_before = 0, excess_before = 0, period_s = 0;
    for (const TruthRow& row : truths_of("hemisphere")) {
        if (row.is_limit()) continue;
        const double k = row["wave_number_radpm"];
        const double excess = gravity_mps2 * k * (hull.mass_kg() + row["a22"]) / stiffness_npm - 1;
        if (excess_before < 0 && excess >= 0) {
            const double resonance = k - (k - k_before) * excess / (excess - excess_before);
            period_s = two_pi / std::sqrt(gravity_mps2 * resonance);
        }
        k_before = k, excess_before = excess;
    }
    EXPECT_NEAR(hull.afloat().heave_period_s / period_s, 1, 0.01);
}

TEST(GivenCoefficients, WavesFromTheSideHeaveAsFromAhead) {
    const Hull hull = given_hemisphere(true);
    // the file has headings each 90 degrees
    EXPECT_NEAR(heave_in_waves(hull, 1, 1.1), heave_in_waves(hull, 1), 0.02);
}

SeaState regular_sea(double ka) {
    const double period_s = two_pi / std::sqrt(gravity_mps2 * ka);
    SeaState sea{.waves = WaveModel::regular, .regular_height_m = 0.01 * two_pi / ka, .regular_period_s = period_s};
    sea.loop_period_s = 60 * period_s;
    sea.resolution = 64;
    return sea;
}

TEST(GivenCoefficients, BodiesInFramesHeaveAsInTheWave) {
    const Hull hull = given_hemisphere(true);
    for (const double ka : {0.5, 1.4}) {
        const SeaState sea = regular_sea(ka);
        Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .depth = true});
        ocean.set_water_frame({.sea_level_m = 3, .current_x_mps = 0.2});
        FloatingBodies bodies(make_serial_executor());
        HullState moving = hull.at_rest(5, 7);
        moving.velocity_mps.x = 0.2;
        const std::uint32_t number = bodies.add(hull, moving);
        constexpr int steps = 40, periods = 20;
        const double step_s = sea.regular_period_s / steps;
        double low = 1e9, high = -1e9;
        for (int i = 0; i < steps * periods; ++i) {
            bodies.step(ocean.frame_at((i + 0.5) * step_s), step_s);
            HullState state = bodies.state(number);
            hold_rotations(state);
            bodies.set_state(number, state);
            if (i < steps * (periods - 2)) continue;
            low = std::min(low, state.position_m.y), high = std::max(high, state.position_m.y);
        }
        // extremes of 40 steps a period, and the drift along the waves
        EXPECT_NEAR((high - low) / sea.regular_height_m, heave_in_waves(hull, ka), 0.05 * heave_in_waves(hull, ka))
            << ka;
        EXPECT_NEAR((high + low) / 2, 3, 0.02) << ka;
    }
}

TEST(GivenCoefficients, TheHighestWavesAreThoseOfTheSea) {
    SeaState sea{.resolution = 32, .wind_speed_mps = 9, .depth_m = 30};
    const std::vector<WaveComponent> all = highest_waves_of(sea, 1), most = highest_waves_of(sea, 0.99);
    double sum = 0, kept = 0;
    for (const WaveComponent& wave : all) sum += wave.amplitude_m * wave.amplitude_m;
    for (const WaveComponent& wave : most) kept += wave.amplitude_m * wave.amplitude_m;
    EXPECT_LT(most.size(), all.size());
    EXPECT_GE(kept, 0.99 * sum);
    ExactWater water(sea);
    for (const double time_s : {0.0, 31.5}) {
        water.set_time(time_s);
        const double x = 12, z = -40;
        float height = 0;
        water.sample_surface({.x = {&x, 1}, .z = {&z, 1}}, {.height_m = {&height, 1}});
        double expected = 0;
        for (const WaveComponent& wave : all)
            expected += wave.amplitude_m * std::cos(wave.kx_radpm * x + wave.kz_radpm * z -
                                                    wave.omega_radps * time_s + wave.phase_rad);
        EXPECT_NEAR(static_cast<double>(height), expected, 1e-4 * std::sqrt(sum)) << time_s;
    }
}

// The energy of hull, A(inf) and the waves that it remembers.
TEST(GivenCoefficients, EnergyInStillWaterFallsEachStep) {
    const glm::dvec3 size(4, 2, 3);
    HullOptions options{.mass_kg = 12000};
    const Hull plain(box_mesh(size), options);
    const double waterline_y_m = plain.centre_of_mass_m().y - plain.afloat().height_m;
    options.coefficients = std::make_shared<const GivenCoefficients>(
        lewis_coefficients(plain.mesh(), plain.centre_of_mass_m(), waterline_y_m, 1025).table);
    // no drag: radiation alone
    options.pressure_coefficient = options.suction_coefficient = options.friction_coefficient = 0;
    options.air_coefficient = options.roll_damping = 0;
    const Hull hull(box_mesh(size), options);
    const glm::dvec3 inertia = 12000.0 / 12 * glm::dvec3(2 * 2 + 3 * 3, 4 * 4 + 3 * 3, 4 * 4 + 2 * 2);
    for (const double step_s : {1.0 / 60, 0.1}) {
        HullState state = hull.at_rest(0, 0);
        state.position_m.y += 0.3;
        state.velocity_mps.y = 1;
        state.orientation = glm::normalize(glm::dquat(1, 0, 0, 0.08));
        state.angular_velocity_radps.z = 0.2;
        const StillWater water;
        HullWorkspace workspace;
        hull.loads(water, state, 0, {}, workspace);  // submersion
        const auto energy = [&] {
            return box_energy_j(hull, state, size, inertia) +
                   stored_energy(hull.coefficients()->radiation(), state.radiation);
        };
        const double first = energy(), rest = box_energy_j(hull, hull.at_rest(0, 0), size, inertia);
        double before = first;
        for (int i = 0; i < (is_sanitized ? 50 : 4000); ++i) {
            hull.step(water, state, step_s, {}, workspace);
            const double now = energy();
            // rounding of the sums of the energy itself
            ASSERT_LE(now, before + 1e-13 * first) << step_s << " " << i;
            before = now;
        }
        if (!is_sanitized) EXPECT_LT(before - rest, 0.05 * (first - rest));
    }
}

TEST(GivenCoefficients, ASetMovesBitIdenticallyAfterItIsRestored) {
    const Hull hull = given_hemisphere(true), other = given_hemisphere(false);
    EXPECT_NE(hull.digest(), other.digest());
    EXPECT_NE(other.digest(), hemisphere().digest());
    EXPECT_EQ(other.digest(), given_hemisphere(false).digest());
    const SeaState sea{.resolution = 32, .wind_speed_mps = 6};
    Ocean ocean(sea, {.executor = make_serial_executor(), .queries = true, .depth = true});
    FloatingBodies bodies(make_serial_executor()), threaded(make_default_executor(3));
    for (FloatingBodies* const set : {&bodies, &threaded})
        for (int i = 0; i < 8; ++i) set->add(i % 2 ? hull : other, hull.at_rest(10.0 * i, -3, 0.5 * i));
    const auto advance = [&](FloatingBodies& set, int from, int to) {
        for (int i = from; i < to; ++i) set.step(ocean.frame_at(i / 32.0), 1 / 32.0);
    };
    advance(bodies, 0, 20);
    advance(threaded, 0, 20);
    const std::vector<std::uint8_t> saved = bodies.save_state();
    EXPECT_EQ(threaded.save_state(), saved);
    advance(bodies, 20, 40);
    threaded.restore_state(saved);
    advance(threaded, 20, 40);
    for (std::uint32_t number = 1; number <= 8; ++number) {
        EXPECT_TRUE(equal(bodies.state(number), threaded.state(number))) << number;
        EXPECT_GT(std::fabs(bodies.state(number).radiation.rate[0][1]), 0) << number;
    }
}

TEST(GivenCoefficients, LimitsAreStatedInOneLine) {
    const Hull hull = given_hemisphere(true);
    FloatingBodies bodies(make_serial_executor());
    for (int i = 0; i < 8; ++i) bodies.add(hull, hull.at_rest(10.0 * i, 0));
    EXPECT_EQ(message_of([&] { bodies.add(hull, hull.at_rest(0, 0)); }),
              "the set has 8 bodies with given coefficients, expected at most 8");
    bodies.add(hemisphere(), hull.at_rest(0, 50));
    EXPECT_EQ(message_of([&] { bodies.step(StillWater(), 0.01); }),
              "forces of waves are unavailable in water without a frame, expected the water of a frame, or "
              "coefficients without a file .3");
    const SeaState calm{.resolution = 16, .patch_size_m = 50, .wind_speed_mps = 4};
    SeaState rough = calm;
    rough.wind_speed_mps = 12;
    Ocean ocean(Forecast{.first = calm, .changes = {{.sea = rough, .from_s = 10, .over_s = 5}}},
                {.executor = make_serial_executor(), .queries = true, .depth = true});
    EXPECT_NO_THROW(bodies.step(ocean.frame_at(1), 0.01));
    EXPECT_NE(message_of([&] { bodies.step(ocean.frame_at(12), 0.01); }).find("while the sea changes"),
              std::string::npos);
    EXPECT_NO_THROW(bodies.step(ocean.frame_at(20), 0.01));
    HullState state = hull.at_rest(0, 0);
    HullWorkspace workspace;
    EXPECT_EQ(message_of([&] { hull.step(StillWater(), state, 0.01, {}, workspace); }),
              "the inputs have no diffraction, expected that of a sea: the hull's coefficients have wave forces");
}

TEST(GivenCoefficients, BadFilesAreRejectedInOneLine) {
    const Hull hull = hemisphere();
    const auto message = [&](std::string radiation, std::string excitation = {}) {
        const CoefficientTexts texts{radiation, excitation, "buoy.1", "buoy.3"};
        return message_of([&] { read_coefficients(hull, texts); });
    };
    const std::string good = hemisphere_1();
    EXPECT_EQ(message(good, hemisphere_3()), "");
    EXPECT_EQ(message("2 1 1 nan 0\n" + good), "buoy.1: line 1: column 4 is nan, expected a finite number");
    std::string negative = good;
    const std::string heave = "8.377580e-01 3 3 9.711726e-01 ";
    negative.insert(negative.find(heave) + heave.size(), "-");
    EXPECT_EQ(message(negative), "buoy.1: line 47: B(3,3) is negative, expected damping");
    EXPECT_EQ(message("2 3 3 1 5\n" + good),
              "buoy.1: the period 2 s has no line of (1,1), surge");
    // Numbers with units are larger by the density.
    std::string with_units;
    std::istringstream lines(good);
    for (std::string period, i, j, line; std::getline(lines, line);) {
        std::istringstream cells(line);
        double a = 0, b = 0;
        cells >> period >> i >> j >> a;
        with_units += period + " " + i + " " + j + " " + std::to_string(1025 * a);
        if (cells >> b) with_units += " " + std::to_string(1025 * b);
        with_units += "\n";
    }
    EXPECT_EQ(message(with_units),
              "buoy.1: A(3,3) is 1130000 kg, expected about 1100 kg for this hull: numbers without dimension, A over "
              "rho L^3 and L in metres");
    EXPECT_EQ(message(good, "1 0 1 2 3\n"),
              "buoy.3: line 1: the number of columns is 5, expected 7, PER BETA I MOD PHASE RE IM");
    HullOptions options = hemisphere_options();
    options.coefficients = read_coefficients(hull, {.radiation = good});
    options.heave_damping = 0.1;
    EXPECT_EQ(Hull::check(hull.mesh(), options), "heave_damping cannot be combined with coefficients");
}

}  // namespace
}  // namespace pelagic
