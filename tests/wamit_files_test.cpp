// Files of panel methods, compared with the same quantities in SI units, and with what must be rejected.
#include "pelagic/floating/wamit_files.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <complex>
#include <numbers>
#include <string>
#include <vector>

#include "pelagic/simd/constants.hpp"
#include "pelagic/tests/hull_states.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/potential_flow.hpp"

namespace pelagic {
namespace {

using Column = WamitScale::Column;

/// Lines of the diagonal and of some couplings at a period or frequency; with B unless it is empty.
std::string diagonal_lines(const std::string& first, const std::string& b = "0.5") {
    std::string text;
    for (int mode = 1; mode <= 6; ++mode) {
        const std::string number = std::to_string(mode);
        text.append(first).append(" ").append(number).append(" ").append(number).append(" 2 ").append(b) += "\n";
    }
    return text;
}

std::string four_periods() {
    return diagonal_lines("1") + diagonal_lines("2") + diagonal_lines("3") + diagonal_lines("4");
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    return text.replace(text.find(from), from.size(), to);
}

std::string rejected_1(const std::string& text, const WamitScale& scale = {}) {
    return message_of([&] { read_wamit_1(text, scale); });
}

std::string rejected_3(const std::string& text, const WamitScale& scale = {}) {
    return message_of([&] { read_wamit_3(text, scale); });
}

TEST(WamitFiles, CoefficientsAreThoseOfThePanelMethodInSiUnits) {
    const RadiationTable table = read_wamit_1(text_of_source("tests/potential_flow/hemisphere.1"), {});
    ASSERT_EQ(table.omega_radps.size(), 26);
    const std::vector<TruthRow> truths = truths_of("hemisphere");
    EXPECT_NEAR(table.infinite_added_mass[1][1], truths[0]["a22"], 1e-4 * truths[0]["a22"]) << "heave";
    EXPECT_NEAR(table.infinite_added_mass[0][0], truths[0]["a11"], 1e-4 * truths[0]["a11"]) << "surge";
    EXPECT_NEAR(table.infinite_added_mass[2][2], truths[0]["a33"], 1e-3 * truths[0]["a33"]) << "sway";
    EXPECT_NEAR(table.infinite_added_mass[0][5], truths[0]["a16"], 1e-3 * truths[0]["a16"]) << "surge and pitch";
    EXPECT_NEAR(table.infinite_added_mass[2][3], truths[0]["a34"], 1e-3 * std::fabs(truths[0]["a34"])) << "sway, roll";
    // Between frequencies, within what a straight line leaves.
    for (const TruthRow& row : truths) {
        const double omega = std::sqrt(gravity_mps2 * row["wave_number_radpm"]);
        if (row.is_limit() || omega < table.omega_radps[1]) continue;
        std::size_t i = 0;
        while (i + 2 < table.omega_radps.size() && table.omega_radps[i + 1] < omega) ++i;
        const double fraction = (omega - table.omega_radps[i]) / (table.omega_radps[i + 1] - table.omega_radps[i]);
        const auto mixed = [&](const std::vector<HullMatrix>& m) {
            return m[i][1][1] + fraction * (m[i + 1][1][1] - m[i][1][1]);
        };
        EXPECT_NEAR(mixed(table.added_mass), row["a22"], 0.02 * row["a22"]) << omega;
        EXPECT_NEAR(mixed(table.damping), row["b22"], 0.1 * row["b22"]) << omega;
    }
}

TEST(WamitFiles, ForcesAreThoseOfThePanelMethodInSiUnits) {
    const ForceTable table = read_wamit_3(text_of_source("tests/potential_flow/hemisphere.3"), {});
    ASSERT_EQ(table.omega_radps.size(), 26);
    ASSERT_EQ(table.heading_rad.size(), 4);
    const auto mixed = [&](double omega, std::size_t heading, std::size_t mode) {
        std::size_t i = 0;
        while (i + 2 < table.omega_radps.size() && table.omega_radps[i + 1] < omega) ++i;
        const double fraction = (omega - table.omega_radps[i]) / (table.omega_radps[i + 1] - table.omega_radps[i]);
        const std::complex<double> a = table.forces[4 * i + heading][mode], b = table.forces[4 * i + 4 + heading][mode];
        return a + fraction * (b - a);
    };
    for (const TruthRow& row : truths_of("hemisphere")) {
        const double omega = std::sqrt(gravity_mps2 * row["wave_number_radpm"]);
        if (row.is_limit() || omega > 4.6) continue;
        const std::complex<double> heave = row.complex("heave_force"), surge = row.complex("surge_force");
        for (std::size_t heading = 0; heading < 4; ++heading)
            EXPECT_LT(std::abs(mixed(omega, heading, 1) - heave), 0.03 * std::abs(heave)) << omega;
        EXPECT_LT(std::abs(mixed(omega, 0, 0) - surge), 0.04 * std::abs(surge)) << "towards +x";
        EXPECT_LT(std::abs(mixed(omega, 2, 0) + surge), 0.04 * std::abs(surge)) << "towards -x";
        // Heading 1 is towards +z: the force of sway, as surge's of waves towards +x.
        EXPECT_LT(std::abs(mixed(omega, 1, 2) - surge), 0.04 * std::abs(surge)) << "towards +z";
        EXPECT_LT(std::abs(mixed(omega, 3, 2) + surge), 0.04 * std::abs(surge)) << "towards -z";
    }
}

TEST(WamitFiles, SurgeOfADeepCylinderIsThatOfMacCamyAndFuchs) {
    // Validates the stored forces: the cylinder of 20 m feels what one to the sea bed feels to that depth.
    for (const TruthRow& row : truths_of("spar")) {
        const double k = row["wave_number_radpm"];
        if (row.is_limit() || k < 0.05) continue;
        const double known = row["maccamy_fuchs_force"];
        EXPECT_NEAR(std::abs(row.complex("surge_force")), known, 0.05 * known) << k;
    }
}

TEST(WamitFiles, ScalesAndAxesAreConverted) {
    const WamitScale scale{.length_m = 2, .density_kgpm3 = 1000, .gravity_mps2 = 10};
    std::string text = four_periods();
    // sway with roll and yaw, heave with pitch, at the longest period
    text += "4 2 4 0.1 0.01\n4 4 2 0.1 0.01\n4 2 6 0.2 0.02\n4 6 2 0.2 0.02\n4 3 5 0.3 0.03\n4 5 3 0.3 0.03\n";
    const RadiationTable table = read_wamit_1(text, scale);
    const double omega = two_pi / 4;
    EXPECT_NEAR(table.omega_radps[0], omega, 1e-12);
    const HullMatrix &a = table.added_mass[0], &b = table.damping[0];
    EXPECT_DOUBLE_EQ(a[1][1], 2 * 1000 * 8);
    EXPECT_DOUBLE_EQ(a[5][5], 2 * 1000 * 32);
    EXPECT_NEAR(b[2][2], 0.5 * 1000 * 8 * omega, 1e-9);
    // Our sway is to starboard, theirs to port; our pitch lowers the stern, theirs the bow.
    EXPECT_NEAR(a[2][3], -0.1 * 1000 * 16, 1e-9);
    EXPECT_NEAR(a[2][4], -0.2 * 1000 * 16, 1e-9);
    EXPECT_NEAR(a[1][5], -0.3 * 1000 * 16, 1e-9);
    EXPECT_NEAR(b[1][5], -0.03 * 1000 * 16 * omega, 1e-9);
    EXPECT_EQ(a[3][2], a[2][3]);

    // A column of frequencies, and limits.
    std::string frequencies = diagonal_lines("0", "") + diagonal_lines("-1", "") + diagonal_lines("0.5") +
                              diagonal_lines("1.0D0") + diagonal_lines("1.5E+00") + diagonal_lines("2");
    const RadiationTable by_frequency =
        read_wamit_1(replaced(frequencies, "-1 1 1 2", "-1 1 1 3"),
                     {.first_column = Column::omega_radps, .density_kgpm3 = 1000});
    EXPECT_EQ(by_frequency.omega_radps, (std::vector<double>{0.5, 1, 1.5, 2}));
    EXPECT_DOUBLE_EQ(by_frequency.infinite_added_mass[0][0], 3000);
    EXPECT_DOUBLE_EQ(by_frequency.infinite_added_mass[1][1], 2000);
}

TEST(WamitFiles, AnotherOriginMovesMomentsAndPhases) {
    // A mass of 2000 kg in surge at an origin 3 m above the centre of mass: surge there is -3 m times pitch.
    const WamitScale scale{.density_kgpm3 = 1000, .origin_m = {4, 3, 0}};
    const HullMatrix a = read_wamit_1(four_periods(), scale).added_mass[0];
    EXPECT_NEAR(a[0][5], -3 * 2000, 1e-9);
    EXPECT_NEAR(a[1][5], 4 * 2000, 1e-9);
    EXPECT_NEAR(a[5][5], (9 + 16 + 1) * 2000, 1e-9);
    // Heave force of waves towards +x at an origin 4 m ahead: later by 4 k, and a moment of 4 m.
    std::string text;
    for (const char* period : {"4", "5"})
        for (int mode = 1; mode <= 6; ++mode)
            text += std::string(period) + " 0 " + std::to_string(mode) + (mode == 3 ? " 1 0 1 0\n" : " 0 0 0 0\n");
    const ForceTable table = read_wamit_3(text, scale);
    const double omega = table.omega_radps[0], k = omega * omega / gravity_mps2;
    const std::complex<double> force = table.forces[0][1];
    EXPECT_NEAR(std::abs(force), 1000 * gravity_mps2, 1e-6);
    EXPECT_NEAR(std::arg(force), -4 * k, 1e-9);
    EXPECT_LT(std::abs(table.forces[0][5] - 4.0 * force), 1e-6);
}

TEST(WamitFiles, HalfOfTheHeadingsIsMirrored) {
    std::string text;
    for (const char* period : {"4", "5"})
        for (const char* heading : {"0", "60", "180"})
            for (int mode = 1; mode <= 6; ++mode)
                text += std::string(period) + " " + heading + " " + std::to_string(mode) + " 1 0 1 0\n";
    const ForceTable table = read_wamit_3(text, {});
    ASSERT_EQ(table.heading_rad.size(), 4);
    // 60 degrees to port are 300 degrees in our direction, towards starboard.
    EXPECT_NEAR(table.heading_rad[1], std::numbers::pi / 3, 1e-12);
    EXPECT_NEAR(table.heading_rad[3], 5 * std::numbers::pi / 3, 1e-12);
    for (const std::size_t mode : {0, 1, 5}) EXPECT_EQ(table.forces[1][mode], table.forces[3][mode]) << mode;
    for (const std::size_t mode : {2, 3, 4}) EXPECT_EQ(table.forces[1][mode], -table.forces[3][mode]) << mode;
}

TEST(WamitFiles, BadCoefficientsGetOneLine) {
    const std::string good = four_periods();
    EXPECT_EQ(rejected_1(good), "");
    EXPECT_EQ(rejected_1(replaced(good, "2 3 3 2 0.5", "2 3 3 2 -0.5")),
              "line 9: B(3,3) is negative, expected damping");
    EXPECT_EQ(rejected_1(replaced(good, "2 3 3 2 0.5\n", "")), "the period 2 s has no line of (3,3), heave");
    EXPECT_EQ(rejected_1(replaced(good, "2 3 3 2 0.5", "2 3 3 2")),
              "line 9: the number of columns is 4, expected 5, PER I J A(I,J) B(I,J)");
    EXPECT_EQ(rejected_1(replaced(good, "2 3 3 2 0.5", "2 3 7 2 0.5")),
              "line 9: the mode is 7, expected a whole number from 1 to 6");
    EXPECT_EQ(rejected_1(replaced(good, "2 3 3 2 0.5", "2 3 3 nan 0.5")),
              "line 9: column 4 is nan, expected a finite number");
    EXPECT_EQ(rejected_1(replaced(good, "2 3 3 2 0.5", "2 3 3 1e400 0.5")),
              "line 9: column 4 is 1e400, expected a finite number");
    EXPECT_EQ(rejected_1(replaced(good, "2 3 3 2 0.5", "2 3 3 1e14 0.5")),
              "line 9: A(3,3) or B(3,3) is beyond 1e15 in SI units, expected another scale");
    EXPECT_EQ(rejected_1(good + "2 3 3 2 0.5\n"), "line 25: (3,3) is given twice, first in line 9");
    EXPECT_EQ(rejected_1("PER I J A B\n" + good), "line 1: column 1 is PER, expected a finite number");
    EXPECT_EQ(rejected_1(diagonal_lines("1")), "the number of finite frequencies is 1, expected 4 or more");
    EXPECT_EQ(rejected_1(""), "the number of finite frequencies is 0, expected 4 or more");
    EXPECT_EQ(rejected_1("1 1 1 1 1 1 1 1 1\n"), "line 1: more than 8 columns");
    EXPECT_EQ(rejected_1(good, {.length_m = 0}), "length_m 0 is out of range [1e-3, 1e4] m");
    EXPECT_EQ(rejected_1(std::string(max_wamit_lines + 1, '\n')), "the file has more than 200000 lines");
    std::string many;
    for (int i = 0; i < 300; ++i) many += diagonal_lines(std::to_string(1 + i));
    EXPECT_EQ(rejected_1(many), "line 1549: more than 256 frequencies");
    EXPECT_EQ(rejected_1(replaced(good, "2 3 3 2 0.5", "2 3 3 \x1b[31m 0.5")).find('\x1b'), std::string::npos);
}

TEST(WamitFiles, BadForcesGetOneLine) {
    std::string good;
    for (const char* period : {"4", "5"})
        for (const char* heading : {"0", "90"})
            for (int mode = 1; mode <= 6; ++mode)
                good += std::string(period) + " " + heading + " " + std::to_string(mode) + " 2 90 0 2\n";
    EXPECT_EQ(rejected_3(good), "");
    EXPECT_EQ(rejected_3(replaced(good, "4 90 3 2 90 0 2\n", "")),
              "the period 4 s has no line of mode 3, heave, at 90 degrees");
    EXPECT_EQ(rejected_3(replaced(good, "4 90 3 2 90 0 2", "4 90 3 2 1.5708 0 2")),
              "line 9: MOD and PHASE (degrees) do not agree with RE and IM");
    EXPECT_EQ(rejected_3(replaced(good, "4 90 3 2 90 0 2", "4 90 3 2 90")),
              "line 9: the number of columns is 5, expected 7, PER BETA I MOD PHASE RE IM");
    EXPECT_EQ(rejected_3(replaced(good, "4 90 3 2 90 0 2", "4 45 3 2 90 0 2")),
              "the period 4 s has other headings than the period 5 s");
    EXPECT_EQ(rejected_3(good + "4 90 3 2 90 0 2\n"), "line 25: mode 3 is given twice, first in line 9");
    EXPECT_EQ(rejected_3(""), "the number of frequencies is 0, expected 2 or more");
    EXPECT_EQ(rejected_3(replaced(good, "4 90 3", "4 1e4 3")),
              "line 9: BETA 10000 is out of range [-720, 720] degrees");
}

}  // namespace
}  // namespace pelagic
