// `pelagic query --hull`, and hulls in events files.
#include <gtest/gtest.h>

#include <charconv>
#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <vector>

#include "pelagic/simd/constants.hpp"
#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tests/test_paths.hpp"
#include "pelagic/tools/events/event_player.hpp"
#include "pelagic/tools/text/errors.hpp"

namespace pelagic {
namespace {

class HullCommand : public ::testing::Test {
   protected:
    enum Column { time, x, y, z, heave, heading, pitch, roll, vx, vy, vz, draught, displaced, columns };
    static constexpr const char* header = "time,x,y,z,heave,heading,pitch,roll,vx,vy,vz,draught,displaced";
    static constexpr double length_m = 4, beam_m = 2, mass_kg = 2000, density_kgpm3 = 1025;
    /// A box of 4 x 1 x 2 m around the origin.
    static constexpr const char* box =
        "v -2 -0.5 -1\nv 2 -0.5 -1\nv 2 0.5 -1\nv -2 0.5 -1\nv -2 -0.5 1\nv 2 -0.5 1\nv 2 0.5 1\nv -2 0.5 1\n"
        "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n";

    void SetUp() override { write_file(folder_ / "box.obj", box); }

    /// Runs a query of the box on a small sea.
    Outcome query(const Arguments& more, const std::string& wind_mps = "0.3") const {
        const Arguments all = {"query",
                               "--hull",
                               (folder_ / "box.obj").string(),
                               "--mass",
                               "2000",
                               "--resolution",
                               "32",
                               "--cascades",
                               "1",
                               "--patch-size",
                               "100",
                               "--wind-speed",
                               wind_mps,
                               "--events-resolution",
                               "128"};
        return run_pelagic(joined(all, more));
    }

    static std::vector<std::vector<double>> rows_of(const Outcome& run) {
        EXPECT_EQ(run.exit_code, 0) << run.err;
        std::istringstream lines(run.out);
        std::string line;
        std::getline(lines, line);
        EXPECT_EQ(line, header);
        std::vector<std::vector<double>> rows;
        while (std::getline(lines, line)) {
            std::vector<double>& row = rows.emplace_back();
            const char *at = line.data(), *end = at + line.size();
            while (at < end) {
                at = std::from_chars(at, end, row.emplace_back()).ptr;
                if (at < end) ++at;
            }
            EXPECT_EQ(row.size(), columns) << line;
        }
        return rows;
    }

    TemporaryFolder folder_;
};

// Archimedes: the draught is mass / (density length beam), and the centre floats half the height
// above the lowest side. Waves of 0.3 m/s of wind are millimetres high.
TEST_F(HullCommand, ABoxFloatsAtItsDraught) {
    const auto rows = rows_of(query({"--hull-position", "3,-5", "--hull-heading", "-30", "--sea-level", "2"}));
    ASSERT_EQ(rows.size(), 1u);
    const double expected_m = mass_kg / (density_kgpm3 * length_m * beam_m);
    EXPECT_NEAR(rows[0][draught], expected_m, 0.005 * expected_m + 0.002);
    EXPECT_NEAR(rows[0][displaced], mass_kg / density_kgpm3, 0.01);
    EXPECT_NEAR(rows[0][y], 2 + 0.5 - expected_m, 0.005);
    EXPECT_NEAR(rows[0][heave], 0, 0.005);
    EXPECT_NEAR(rows[0][x], 3, 0.2);
    EXPECT_NEAR(rows[0][z], -5, 0.2);
    EXPECT_NEAR(rows[0][heading], -30, 1);
    EXPECT_NEAR(rows[0][pitch], 0, 0.3);
    EXPECT_NEAR(rows[0][roll], 0, 0.3);
}

// Newton: before the drag matters, the thrust accelerates the mass and the added mass of surge. A
// heading of 90 degrees is towards +z.
TEST_F(HullCommand, ThrustMovesItTowardsItsBow) {
    const auto rows = rows_of(query({"--hull-thrust", "1000", "--hull-heading", "90", "--times", "0:4:2"}));
    ASSERT_EQ(rows.size(), 3u);
    for (const auto& row : rows) {
        // At most the speed at which the drag of the front and back, 1.05, balances the thrust.
        const double top_mps = std::sqrt(2 * 1000 / (density_kgpm3 * 1.05 * beam_m * rows[0][draught]));
        EXPECT_GT(row[vz], 0.5 * top_mps);
        EXPECT_LT(row[vz], top_mps);
        EXPECT_LT(std::fabs(row[vx]), 0.1);
    }
    // Position and velocity agree: the trapezoid of two seconds.
    EXPECT_NEAR(rows[1][z] - rows[0][z], rows[0][vz] + rows[1][vz], 0.1);
}

// Rows depend on the first time, but not on the other times; and the sea's waves move the hull.
TEST_F(HullCommand, RowsDoNotDependOnOtherTimes) {
    const auto fine = rows_of(query({"--times", "1:2:0.125"}, "8")),
               coarse = rows_of(query({"--times", "1:2:0.5"}, "8"));
    ASSERT_EQ(fine.size(), 9u);
    ASSERT_EQ(coarse.size(), 3u);
    for (std::size_t i = 0; i < coarse.size(); ++i) EXPECT_EQ(coarse[i], fine[4 * i]);
    EXPECT_GT(std::fabs(fine[8][pitch] - fine[0][pitch]), 0.1);
}

TEST_F(HullCommand, JsonHasTheValuesOfTheTable) {
    const auto rows = rows_of(query({"--times", "0:1:0.5"}));
    const auto printed = nlohmann::ordered_json::parse(query({"--times", "0:1:0.5", "--json"}).out);
    ASSERT_EQ(printed.size(), rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        std::string names;
        std::size_t column = 0;
        for (const auto& [name, value] : printed[i].items()) {
            names += (names.empty() ? "" : ",") + name;
            EXPECT_EQ(value.get<double>(), rows[i][column++]);
        }
        EXPECT_EQ(names, header);
    }
}

TEST_F(HullCommand, InvalidOptionsAreRejectedInOneLine) {
    const std::string file = (folder_ / "box.obj").string(), none = (folder_ / "none.obj").string();
    const std::vector<std::pair<std::string, Arguments>> cases = {
        {"--mass is 5; it requires --hull", {"--mass", "5"}},
        {"--hull-thrust is 5; it requires --hull", {"--hull-thrust", "5"}},
        {"--mass is missing: --hull needs the mass", {"--hull", file}},
        {"--mass 0 is out of range [1e-6, 1e10] kg", {"--hull", file, "--mass", "0"}},
        {"--mass is 9000, expected less than 8200 kg", {"--hull", file, "--mass", "9000"}},
        {"--hull-position is 1, expected X,Z", {"--hull", file, "--mass", "9", "--hull-position", "1"}},
        {"--hull-heading 400 is out of range", {"--hull", file, "--mass", "9", "--hull-heading", "400"}},
        {"--hull-center is 9,0,0: centre_of_mass_m.x", {"--hull", file, "--mass", "9", "--hull-center", "9,0,0"}},
        {"--hull-coefficients is 5; it requires --hull", {"--hull-coefficients", "5"}},
        {"none.obj.1, which can't be read", {"--hull", file, "--mass", "9", "--hull-coefficients", none}},
        {"bad.1: line 1: column 4 is x, expected a finite number",
         {"--hull", file, "--mass", "9", "--hull-coefficients", (folder_ / "bad").string()}},
        {"none.obj, which can't be read", {"--hull", none, "--mass", "9"}},
        {"--points cannot be combined with --hull", {"--hull", file, "--mass", "9", "--points", "-"}},
        {"--footprint cannot be combined with --hull", {"--hull", file, "--mass", "9", "--footprint", "9"}},
        {"--foam cannot be combined with --hull", {"--hull", file, "--mass", "9", "--foam"}},
        {"--events-side is 5; it requires --events", {"--events-side", "5"}},
        {"expected at most 86400 s",
         {"--hull", file, "--mass", "9", "--loop-period", "86400", "--times", "0:86410:10"}},
    };
    write_file(folder_ / "bad.1", "2 1 1 x 0\n");
    for (const auto& [reason, more] : cases) {
        const Outcome run = run_pelagic(joined({"query"}, more));
        EXPECT_EQ(run.exit_code, 2);
        EXPECT_EQ(run.out, "");
        EXPECT_NE(run.err.find(reason), std::string::npos) << "expected " << reason << ": " << run.err;
        EXPECT_EQ(std::count(run.err.begin(), run.err.end(), '\n'), 1) << run.err;
    }
}

/// A box has other coefficients than a hemisphere, of a similar size.
TEST_F(HullCommand, CoefficientsComeFromTheFilesOfAPanelMethod) {
    const std::string stem = in_sources("tests/potential_flow/hemisphere");
    const Arguments times = {"--times", "0:1:0.5"}, given = {"--times", "0:1:0.5", "--hull-coefficients", stem};
    const auto rows = rows_of(query(given, "8"));
    EXPECT_NE(rows, rows_of(query(times, "8")));
    EXPECT_EQ(rows, rows_of(query(given, "8")));
    const double expected_m = mass_kg / (density_kgpm3 * length_m * beam_m);
    EXPECT_NEAR(rows_of(query(given))[0][draught], expected_m, 0.005 * expected_m + 0.002);
    expect_one_line(query({"--waves", "pond", "--hull-coefficients", stem}), 2,
                    "--hull-coefficients: forces of waves are unavailable in a pond, expected ");
}

TEST_F(HullCommand, AHullThatFliesAwayIsNamedByItsOptions) {
    expect_one_line(run_pelagic({"query", "--hull", (folder_ / "box.obj").string(), "--mass", "4000", "--hull-thrust",
                                 "1e12", "--resolution", "32", "--cascades", "1"}),
                    2, "--mass 4000 --hull-thrust 1e12: the hull moves out of range: ");
}

// The box in still water: closed forms of the stiffnesses rho g A and m g GM. Masses over these are the squares of
// periods over 2 pi, with an added mass of at most three times the mass.
TEST_F(HullCommand, PrintsNaturalPeriodsAndLimits) {
    const Outcome run = query({"--times", "0:1:1"});
    EXPECT_EQ(run.exit_code, 0);
    const auto number_after = [&](const std::string& text) {
        const std::size_t at = run.err.find(text);
        EXPECT_NE(at, std::string::npos) << run.err;
        return at == std::string::npos ? 0 : std::stod(run.err.substr(at + text.size()));
    };
    constexpr double g = 9.80665, pi = 3.14159265358979;
    const double draught = mass_kg / (density_kgpm3 * length_m * beam_m);
    const double heave_s = 2 * pi * std::sqrt(mass_kg / (density_kgpm3 * g * length_m * beam_m));
    const double gm_m = draught / 2 - 0.5 + beam_m * beam_m / (12 * draught),
                 roll_s = 2 * pi * std::sqrt((beam_m * beam_m + 1) / 12 / (g * gm_m));
    EXPECT_GT(number_after("heave "), heave_s);
    EXPECT_LT(number_after("heave "), 2 * heave_s);
    EXPECT_GT(number_after("roll "), roll_s);
    EXPECT_LT(number_after("roll "), 2 * roll_s);
    // 100 m over 32 texels, 4.2 of them
    EXPECT_NEAR(number_after("velocities of waves from "), 13.1, 0.1);
    EXPECT_EQ(run.out.find("note"), std::string::npos);
    // in a sea whose waves the grid holds and the hull is small against, only the periods are printed
    const Outcome fits = run_pelagic({"query", "--hull", (folder_ / "box.obj").string(), "--mass", "2000", "--times",
                                      "0:0.1:0.1", "--resolution", "64"});
    EXPECT_NE(fits.err.find("length over peak wavelength: 0.0"), std::string::npos) << fits.err;
    EXPECT_EQ(fits.err.find("expected at most"), std::string::npos) << fits.err;
}

TEST_F(HullCommand, AHullThatCapsizesIsNoted) {
    write_file(folder_ / "tall.obj",
               "v -2 0 -1\nv 2 0 -1\nv 2 6 -1\nv -2 6 -1\nv -2 0 1\nv 2 0 1\nv 2 6 1\nv -2 6 1\n"
               "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 4 8 7 3\nf 1 5 8 4\nf 2 3 7 6\n");
    const Outcome run = run_pelagic({"query", "--hull", (folder_ / "tall.obj").string(), "--mass", "20000",
                                     "--resolution", "32", "--cascades", "1"});
    EXPECT_EQ(run.exit_code, 0);
    // KB - KG + I/V = d/2 - 3 + beam^2 / (12 d) with the draught d = 20000 / (1025 8).
    const double d = 20000 / (density_kgpm3 * length_m * beam_m);
    const std::size_t at = run.err.find("metacentric height is ");
    ASSERT_NE(at, std::string::npos) << run.err;
    EXPECT_NEAR(std::stod(run.err.substr(at + 22)), d / 2 - 3 + beam_m * beam_m / (12 * d), 0.01);
}

// Events: at rest, the surface sinks by the draught of the hull (sim/pressure_footprint.hpp), over
// its area, turned by its heading.
TEST_F(HullCommand, AHullOfEventsPressesItsVolumeIntoTheWater) {
    using namespace tools;
    const std::string name = (folder_ / "events.csv").string();
    EventOptions options{.file = std::make_shared<const EventFile>(parse_events(
                             name, "time,x,z,radius,height,duration,heading,hull\n0,1,2,,-0.25,100,90,box.obj\n")),
                         .water = {.resolution = 128, .side_m = 32, .border_m = 6},
                         .middle_x_m = 1,
                         .middle_z_m = 2};
    EventPlayer player(options, make_serial_executor(), {});
    double volume_m3 = 0;
    DynamicWavesView view;
    // Long after the launch the waves have left.
    for (int i = 1; i <= 60; ++i) view = player.at(i * 0.5);
    constexpr double texel_m = 0.25;
    for (double at_x = -2; at_x <= 4; at_x += texel_m)
        for (double at_z = -1; at_z <= 5; at_z += texel_m)
            volume_m3 -= sample(view, at_x, at_z).height_m * texel_m * texel_m;
    EXPECT_NEAR(sample(view, 1, 2).height_m, -0.25, 0.01);
    EXPECT_NEAR(sample(view, 1, 3.5).height_m, -0.25, 0.03) << "length along z";
    EXPECT_NEAR(sample(view, 2.5, 2).height_m, 0, 0.03) << "beam along x";
    EXPECT_NEAR(volume_m3, 0.25 * length_m * beam_m, 0.1);
}

TEST_F(HullCommand, InvalidHullsOfEventsAreRejected) {
    const std::string name = (folder_ / "events.csv").string(), first = "time,x,z,radius,height,duration,mode,hull\n";
    for (const auto& [reason, row] : std::vector<std::pair<std::string, std::string>>{
             {":2: duration is 0, expected above 0 with a hull", "0,0,0,,-1,,,box.obj"},
             {":2: height is 1, expected below 0 with a hull", "0,0,0,,1,9,,box.obj"},
             {":2: mode is relaxation, expected pressure with a hull", "0,0,0,,-1,9,relaxation,box.obj"},
             {":2: radius is , expected metres", "0,0,0,,-1,9,,"},
             {":2: hull is ", "0,0,0,,-1,9,,none.obj"},
         })
        try {
            tools::parse_events(name, first + row);
            ADD_FAILURE() << row;
        } catch (const tools::InputError& error) {
            EXPECT_NE(std::string(error.what()).find(reason), std::string::npos) << error.what();
        }
    write_file(name, first + "0,0,0,,-1,9,,box.obj\n");
    const Outcome run = run_pelagic({"export", "--out", (folder_ / "out").string(), "--events", name});
    EXPECT_EQ(run.exit_code, 2);
    EXPECT_NE(run.err.find("--events has a hull"), std::string::npos) << run.err;
}

}  // namespace
}  // namespace pelagic
