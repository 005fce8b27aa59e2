// Wind on the command line and in files, in the units and directions of sailors and meteorologists.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>
#include <string>
#include <vector>

#include "pelagic/tests/run_pelagic.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic {
namespace {

nlohmann::json sea_of_options(std::vector<std::string> arguments, const std::string& config = {}) {
    const TemporaryFolder folder;
    arguments.insert(arguments.begin(), {"info", "--json", "--resolution", "16"});
    if (!config.empty()) {
        write_file(folder / "sea.toml", config);
        arguments.insert(arguments.end(), {"--config", (folder / "sea.toml").string()});
    }
    const Outcome outcome = run_pelagic(arguments);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out).at("sea");
}

double speed(const std::string& text) { return tools::parse_speed_mps(text).value_or(-1); }

TEST(WindSpeed, HasUnits) {
    // By definition 1 kn = 1852 m an hour and 1 mph = 0.44704 m/s.
    EXPECT_DOUBLE_EQ(speed("9"), 9);
    EXPECT_DOUBLE_EQ(speed("9.5m/s"), 9.5);
    EXPECT_NEAR(speed("20kn"), 20 * 0.514444444, 1e-7);
    EXPECT_NEAR(speed("20 kn"), 20 * 0.514444444, 1e-7);
    for (const char* text : {"9knots", "9 knots", "9knot"}) EXPECT_DOUBLE_EQ(speed(text), speed("9kn")) << text;
    EXPECT_DOUBLE_EQ(speed("36km/h"), 10);
    EXPECT_DOUBLE_EQ(speed("100mph"), 44.704);
    for (const char* text : {"", "kn", "knots", "20knotss", "20  knots", "20  kn", "bft", "bft0", "bft13", "bft6.5",
                             "6bft", "nankn", "20kn ", "0x9"})
        EXPECT_FALSE(tools::parse_speed_mps(text)) << text;
}

TEST(Durations, HaveUnits) {
    for (const char* text : {"90", "90s", "90 s", "1.5min", "1.5 min"})
        EXPECT_EQ(tools::parse_seconds(text), 90) << text;
    for (const char* text : {"", "s", "min", "4h", "4  s", "4sec", "4 s "})
        EXPECT_FALSE(tools::parse_seconds(text)) << text;
    EXPECT_EQ(sea_of_options({"--loop-period", "2min"}).at("loop_period_s"), 120);
    const auto of_file = sea_of_options({}, "loop_period = \"90 s\"\nswell_height = 1\nswell_period = \"14s\"\n");
    EXPECT_EQ(of_file.at("swell_period_s"), 14);
    expect_one_line(run_pelagic({"info", "--loop-period", "4h"}), 2,
                    "--loop-period 4h is out of range [0.1, 86400] s, or with a unit such as 4s, 2min");
}

// A loop holds whole periods, so one of 4 s has waves of 4 s where the model's peak is at 6.6 s.
TEST(Durations, OfAPeakInAShortLoopArePrinted) {
    const Outcome info = run_pelagic({"info", "--loop-period", "4s"});
    EXPECT_NE(info.out.find("peak 6.62 s, in this loop 4 s ("), std::string::npos) << info.out;
    EXPECT_NE(info.out.find("a loop of 4 s changes the peak period by 40 %, to 4 s: "), std::string::npos)
        << info.out;
    EXPECT_EQ(run_pelagic({"info"}).out.find("in this loop"), std::string::npos);
}

// The ranges of the World Meteorological Organization's table, m/s (Manual on Codes, code table
// 1100).
TEST(WindSpeed, OfABeaufortForceIsInItsRange) {
    const double from[] = {0.3, 1.6, 3.4, 5.5, 8.0, 10.8, 13.9, 17.2, 20.8, 24.5, 28.5, 32.7, 37.0};
    for (int force = 1; force <= 12; ++force) {
        const double mps = speed("bft" + std::to_string(force));
        EXPECT_GE(mps, from[force - 1]) << force;
        EXPECT_LT(mps, from[force]) << force;
    }
}

TEST(WindDirection, OfACompassPointIsItsBearing) {
    // +x is east and -z north: a bearing b, clockwise from north, points to (sin b, -cos b).
    const char* const points[] = {"N", "NNE", "NE", "ENE", "E", "ESE", "SE", "SSE",
                                  "S", "SSW", "SW", "WSW", "W", "WNW", "NW", "NNW"};
    constexpr double degree = std::numbers::pi / 180;
    for (int i = 0; i < 16; ++i) {
        const double bearing = 22.5 * i * degree;
        const double to = tools::parse_compass_deg("to-" + std::string(points[i])).value() * degree;
        EXPECT_NEAR(std::cos(to), std::sin(bearing), 1e-12) << points[i];
        EXPECT_NEAR(std::sin(to), -std::cos(bearing), 1e-12) << points[i];
        const double from = tools::parse_compass_deg("from-" + std::string(points[i])).value() * degree;
        EXPECT_NEAR(std::cos(from), -std::cos(to), 1e-12) << points[i];
        EXPECT_NEAR(std::sin(from), -std::sin(to), 1e-12) << points[i];
    }
    for (const char* text : {"NW", "from-", "from-nw", "from-NNNW", "to-", "towards-N", "to-to-N"})
        EXPECT_FALSE(tools::parse_compass_deg(text)) << text;
}

TEST(Wind, IsTakenFromFlagsAndFiles) {
    const nlohmann::json typed = sea_of_options({"--wind-speed", "20kn", "--wind-direction", "from-NW"});
    EXPECT_NEAR(typed.at("wind_speed_mps").get<double>(), 10.288888889, 1e-8);
    EXPECT_EQ(typed.at("wind_direction_deg"), 45);
    EXPECT_EQ(sea_of_options({}, "wind_speed = \"20kn\"\nwind_direction = \"to-SE\"\n"), typed);
    EXPECT_NEAR(sea_of_options({}, "wind_speed = \"bft6\"\n").at("wind_speed_mps").get<double>(), 12.29, 0.005);
}

TEST(Roughness, IsANumberOrFollowsFromTheWind) {
    EXPECT_EQ(sea_of_options({}).at("roughness"), -1);
    EXPECT_EQ(sea_of_options({"--roughness", "0.3"}).at("roughness"), 0.3);
    EXPECT_EQ(sea_of_options({"--roughness", "wind"}, "roughness = 0.3\n").at("roughness"), -1);
    EXPECT_EQ(sea_of_options({}, "roughness = \"wind\"\n").at("roughness"), -1);
}

TEST(Lean, IsANumberOrFollowsFromTheWind) {
    EXPECT_EQ(sea_of_options({}).at("lean"), -1);
    EXPECT_EQ(sea_of_options({"--lean", "0.3"}).at("lean"), 0.3);
    EXPECT_EQ(sea_of_options({"--lean", "wind"}, "lean = 0\n").at("lean"), -1);
}

TEST(Swell, IsTakenFromFlagsAndFiles) {
    const nlohmann::json typed = sea_of_options({"--swell-height", "2.5", "--swell-period", "14", "--swell-direction",
                                                 "from-W", "--swell-spread", "20", "--spreading", "donelan-banner"});
    EXPECT_EQ(typed.at("swell_height_m"), 2.5);
    EXPECT_EQ(typed.at("swell_period_s"), 14);
    EXPECT_EQ(typed.at("swell_direction_deg"), 0);
    EXPECT_EQ(typed.at("swell_spread_deg"), 20);
    EXPECT_EQ(typed.at("spreading"), "donelan-banner");
    EXPECT_EQ(sea_of_options({},
                             "swell_height = 2.5\nswell_period = 14\nswell_direction = \"to-E\"\nswell_spread = 20\n"
                             "spreading = \"donelan-banner\"\n"),
              typed);
    EXPECT_EQ(sea_of_options({}).at("swell_spread_deg"), 15);
    EXPECT_EQ(sea_of_options({"--preset", "storm"}).at("swell_spread_deg"), 15);
}

TEST(Wind, IncompleteValuesAreRejected) {
    for (const auto& [arguments, says] : std::vector<std::pair<std::vector<std::string>, std::string>>{
             {{"info", "--wind-direction", "NW"}, "--wind-direction is NW, expected from-NW or to-NW"},
             {{"info", "--wind-direction", "north"}, "from-NW or to-SE"},
             {{"info", "--wind-speed", "20leagues"},
              "--wind-speed 20leagues is out of range (0, 60] m/s, or with a unit"},
             {{"info", "--wind-speed", "200kn"}, "--wind-speed 200kn is out of range (0, 60] m/s"},
             {{"info", "--fetch", "100km"}, "--fetch 100km is out of range (0, 2e6]"}}) {
        const Outcome outcome = run_pelagic(arguments);
        EXPECT_EQ(outcome.exit_code, 2) << says;
        EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
        EXPECT_NE(outcome.err.find(says), std::string::npos) << outcome.err << "lacks " << says;
    }
    const std::string help = run_pelagic({"info", "--help"}).out;
    for (const char* part : {"20kn", "bft6", "from-NW", "+x (east)", "+z (south)"})
        EXPECT_NE(help.find(part), std::string::npos) << part;
}

}  // namespace
}  // namespace pelagic
