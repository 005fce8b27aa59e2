// Radiation forces with memory, compared with the coefficients that they are fitted to, with the energy of a
// free oscillation, and with the response of a hemisphere in waves by a panel method.
#include "pelagic/floating/radiation_states.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "pelagic/floating/lewis_sections.hpp"
#include "pelagic/floating/matrix6.hpp"
#include "pelagic/floating/wamit_files.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/tests/hull_states.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/potential_flow.hpp"
#include "pelagic/tests/potential_flow_bodies.hpp"

namespace pelagic {
namespace {

RadiationTable hemisphere_table() { return read_wamit_1(text_of_source("tests/potential_flow/hemisphere.1"), {}); }

double largest(const RadiationTable& table, std::size_t mode) {
    double most = 0;
    for (const HullMatrix& damping : table.damping) most = std::max(most, damping[mode][mode]);
    return most;
}

TEST(RadiationStates, FitReproducesDampingAndAddedMass) {
    const RadiationTable table = hemisphere_table();
    const RadiationFit fit = fit_radiation(table);
    for (const std::size_t mode : {0, 1, 2}) {
        const double most = largest(table, mode);
        for (std::size_t i = 0; i < table.omega_radps.size(); ++i) {
            SCOPED_TRACE(table.omega_radps[i]);
            const double omega = table.omega_radps[i];
            EXPECT_NEAR(fit.damping(omega)[mode][mode], table.damping[i][mode][mode], 0.03 * most) << mode;
            // By the relation of Kramers and Kronig; the data end at 7.8 rad/s.
            EXPECT_NEAR(fit.added_mass(omega)[mode][mode], table.added_mass[i][mode][mode],
                        0.05 * table.added_mass[i][mode][mode])
                << mode;
        }
    }
    // Sway and roll about a point above the centre of buoyancy are coupled.
    const double most = std::sqrt(largest(table, 2) * largest(table, 3));
    for (std::size_t i = 0; i < table.omega_radps.size(); ++i)
        EXPECT_NEAR(fit.damping(table.omega_radps[i])[2][3], table.damping[i][2][3], 0.03 * most);
}

TEST(RadiationStates, RetardationIsTheCosineTransformOfTheDamping) {
    const RadiationFit fit = fit_radiation(hemisphere_table());
    for (const double omega : {0.6, 1.5, 2.7, 3.6, 5.0}) {
        double sum = 0;
        constexpr double step_s = 1e-3;
        for (int i = 0; i < 60'000; ++i) {
            const double t = (i + 0.5) * step_s;
            sum += step_s * fit.retardation(t)[1][1] * std::cos(omega * t);
        }
        const double damping = fit.damping(omega)[1][1];
        EXPECT_NEAR(sum, damping, 1e-3 * damping) << omega;
    }
}

TEST(RadiationStates, FitOfSectionsFollowsTheirTable) {
    for (const FloatingBody& body : {hemisphere_body(), barge_body(), dinghy_body()}) {
        SCOPED_TRACE(body.name);
        const RadiationTable table =
            lewis_coefficients(body.mesh, body.centre_of_mass_m, body.waterline_y_m, water_kgpm3).table;
        const RadiationFit fit = fit_radiation(table);
        for (const std::size_t mode : {1, 5})
            // The force of short waves on a flat section ends at kb = 15, and pitch begins as omega^7.
            for (std::size_t i = 0; i < table.omega_radps.size(); ++i)
                EXPECT_NEAR(fit.damping(table.omega_radps[i])[mode][mode], table.damping[i][mode][mode],
                            0.17 * largest(table, mode))
                    << mode << " at " << table.omega_radps[i];
    }
}

/// A body of six modes on springs, in still water.
struct Oscillator {
    explicit Oscillator(const RadiationFit& radiation) : fit(radiation) {
        for (std::size_t i = 0; i < 6; ++i) {
            mass[i][i] = i < 3 ? 2100 : 500;
            spring[i] = i < 3 ? 30e3 : 5e3;
            for (std::size_t j = 0; j < 6; ++j) mass[i][j] += fit.infinite_added_mass[i][j];
        }
    }

    /// Advances by the implicit midpoint rule under an external force.
    void step(double step_s, const Vector6& force) {
        const RadiationStep memory = begin_step(fit, state, step_s);
        HullMatrix matrix = mass;
        Vector6 right = product(mass, velocity);
        // mass (u1 - u0) = step (force - spring (x0 + step/2 mean) + memory), u1 = 2 mean - u0
        for (std::size_t i = 0; i < 6; ++i) {
            right[i] += step_s / 2 * (force[i] - spring[i] * position[i] + memory.force[i]);
            matrix[i][i] += step_s * step_s / 4 * spring[i];
            for (std::size_t j = 0; j < 6; ++j) matrix[i][j] += step_s / 2 * memory.damping[i][j];
        }
        const Vector6 mean = solve(matrix, right);
        complete_step(fit, state, step_s, mean);
        for (std::size_t i = 0; i < 6; ++i) {
            velocity[i] = 2 * mean[i] - velocity[i];
            position[i] += step_s * mean[i];
        }
    }

    double energy() const {
        double sum = dot(velocity, product(mass, velocity)) / 2 + stored_energy(fit, state);
        for (std::size_t i = 0; i < 6; ++i) sum += spring[i] * position[i] * position[i] / 2;
        return sum;
    }

    const RadiationFit& fit;
    RadiationState state;
    HullMatrix mass{};
    Vector6 spring{}, position{}, velocity{};
};

TEST(RadiationStates, EnergyFallsInStillWaterForAnyStep) {
    const RadiationFit fit = fit_radiation(hemisphere_table());
    std::mt19937 random(5);
    std::uniform_real_distribution<double> any(-1, 1);
    for (const double step_s : {1e-3, 1.0 / 60, 0.1, 1.0, 10.0}) {
        SCOPED_TRACE(step_s);
        Oscillator body(fit);
        for (std::size_t i = 0; i < 6; ++i) body.position[i] = any(random), body.velocity[i] = any(random);
        double before = body.energy();
        for (int i = 0; i < 2000; ++i) {
            body.step(step_s, {});
            const double after = body.energy();
            ASSERT_LE(after, before * (1 + 1e-12)) << i;
            before = after;
        }
    }
}

TEST(RadiationStates, NoisyDataGiveAPassiveFit) {
    // Couplings that no matrix of damping has, larger than the geometric mean of the diagonal.
    RadiationTable table = hemisphere_table();
    for (HullMatrix& damping : table.damping)
        damping[0][1] = damping[1][0] = 3 * std::sqrt(damping[0][0] * damping[1][1]);
    const RadiationFit fit = fit_radiation(table);
    for (double omega = 0.1; omega < 20; omega *= 1.1) {
        const HullMatrix damping = fit.damping(omega);
        for (std::size_t i = 0; i < 6; ++i) {
            EXPECT_GE(damping[i][i], 0);
            for (std::size_t j = 0; j < i; ++j)
                EXPECT_LE(std::fabs(damping[i][j]), std::sqrt(damping[i][i] * damping[j][j]) * (1 + 1e-9) + 1e-9);
        }
    }
}

TEST(RadiationStates, HemisphereHeavesInWavesAsByAPanelMethod) {
    const RadiationFit fit = fit_radiation(hemisphere_table());
    const double mass = water_kgpm3 * 2.07924, spring = water_kgpm3 * gravity_mps2 * std::numbers::pi * 0.9959;
    for (const TruthRow& row : truths_of("hemisphere")) {
        const double k = row["wave_number_radpm"];
        if (row.is_limit() || k < 0.099 || k > 2.01) continue;
        SCOPED_TRACE(k);
        const double omega = std::sqrt(gravity_mps2 * k), period_s = two_pi / omega, step_s = period_s / 200;
        const std::complex<double> force = row.complex("heave_force");
        Oscillator body(fit);
        for (std::size_t i = 0; i < 3; ++i) {
            body.mass[i][i] += mass - 2100;
            body.spring[i] = spring;
        }
        std::complex<double> sum = 0;
        constexpr int periods = 40, steps = 200;
        for (int i = 0; i < periods * steps; ++i) {
            const double middle = (i + 0.5) * step_s;
            Vector6 now{};
            now[1] = (force * std::polar(1.0, omega * middle)).real();
            body.step(step_s, now);
            if (i >= (periods - 1) * steps)
                sum += 2.0 / steps * body.position[1] * std::polar(1.0, -omega * (i + 1) * step_s);
        }
        const std::complex<double> known = row.complex("heave");
        EXPECT_NEAR(std::abs(sum), std::abs(known), 0.1 * std::abs(known));
        EXPECT_LT(std::abs(sum - known), 0.15 * std::abs(known)) << "with its phase";
    }
}

TEST(RadiationStates, TablesAreChecked) {
    const RadiationTable good = hemisphere_table();
    EXPECT_EQ(check(good), "");
    RadiationTable bad = good;
    bad.damping[3][1][1] = -1;
    EXPECT_EQ(message_of([&] { fit_radiation(bad); }), "damping[3][1][1] -1 is out of range [0, 1e15]");
    bad = good;
    bad.omega_radps[2] = bad.omega_radps[1];
    EXPECT_NE(check(bad), "");
    bad = good;
    bad.added_mass[0][1][2] = std::nan("");
    EXPECT_NE(check(bad), "");
    bad = good;
    bad.added_mass.pop_back();
    EXPECT_NE(check(bad), "");
    EXPECT_NE(check(RadiationTable{}), "");
}

}  // namespace
}  // namespace pelagic
