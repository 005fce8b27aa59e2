// Wave systems of the command line, of TOML files and of records become equal structs. Expected angles
// are those of the axes: x is east, z is south, and waves from the west run towards +x.
#include "pelagic/tools/options/wave_systems.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <string>
#include <vector>

#include "pelagic/tools/text/errors.hpp"

namespace pelagic::tools {
namespace {

constexpr double half_turn = std::numbers::pi;
const std::vector<std::string> keys_of_seas = {"wind_speed", "system"};

std::vector<WaveSystem> of_toml(const std::string& text) {
    const std::vector<ConfigEntry> entries = parse_config(text, "sea.toml", keys_of_seas);
    return wave_systems_of(entries.at(0));
}

std::vector<WaveSystem> of_json(const std::string& systems) {
    const auto entries = parse_sea_record("{\"sea\": {\"systems\": " + systems + "}}", "sea.json", keys_of_seas);
    return wave_systems_of(entries.at(0));
}

template <class Read>
std::string message_of(Read read) {
    try {
        read();
    } catch (const InputError& error) {
        return error.what();
    }
    return "accepted";
}

double direction_of(const std::string& text) { return parse_wave_systems({text}).at(0).direction_rad; }

TEST(SystemOptions, OfTheCommandLineHaveUnitsOfUsers) {
    const std::vector<WaveSystem> found = parse_wave_systems(
        {"height=1.2 period=12 from=W spread=15",
         " spectrum=pierson-moskowitz  spreading=hasselmann wind-speed=20kn fetch=5e4 peak_enhancement=2 period=0.5min"
         " direction=to-S ",
         "wind_speed=bft4"});
    ASSERT_EQ(found.size(), 3u);
    EXPECT_EQ(found[0], (WaveSystem{.height_m = 1.2, .peak_period_s = 12, .spread_rad = 15 * (half_turn / 180)}));
    EXPECT_EQ(found[1].spectrum, SpectrumModel::pierson_moskowitz);
    EXPECT_EQ(found[1].spreading, SpreadingModel::hasselmann);
    EXPECT_NEAR(found[1].wind_speed_mps, 20 * 1852.0 / 3600, 1e-12);
    EXPECT_EQ(found[1].fetch_m, 5e4);
    EXPECT_EQ(found[1].peak_enhancement, 2);
    EXPECT_EQ(found[1].peak_period_s, 30);
    EXPECT_NEAR(found[1].direction_rad, half_turn / 2, 1e-15);
    EXPECT_NEAR(found[2].wind_speed_mps, 6.688, 1e-12);  // 0.836 B^1.5
}

TEST(SystemOptions, RunWhereTheirDirectionSays) {
    EXPECT_EQ(direction_of("from=W"), 0);
    EXPECT_NEAR(direction_of("from=N"), half_turn / 2, 1e-15);
    EXPECT_NEAR(direction_of("towards=N"), -half_turn / 2, 1e-15);
    EXPECT_NEAR(direction_of("direction=from-N"), half_turn / 2, 1e-15);
    EXPECT_NEAR(direction_of("from=NNE"), 5 * half_turn / 8, 1e-15);
    EXPECT_NEAR(direction_of("towards=30"), half_turn / 6, 1e-15);
    EXPECT_NEAR(direction_of("direction=30"), half_turn / 6, 1e-15);
    EXPECT_NEAR(direction_of("from=30"), -5 * half_turn / 6, 1e-15);
    EXPECT_NEAR(direction_of("from=-30"), 5 * half_turn / 6, 1e-15);
}

TEST(SystemOptions, OfFilesEqualThoseOfTheCommandLine) {
    const std::vector<WaveSystem> typed =
        parse_wave_systems({"height=1.2 period=12 from=W spread=15", "direction=-40"});
    EXPECT_EQ(of_toml("[[system]]\nheight = 1.2\nperiod = \"12s\"\nfrom = \"W\"\nspread = 15\n"
                      "[[system]]\ndirection = -40\n"),
              typed);
    EXPECT_EQ(of_json(R"([{"height_m": 1.2, "peak_period_s": 12, "direction_deg": 0, "spread_deg": 15},
                          {"spectrum": "jonswap", "peak_period_s": 0, "direction_deg": -40}])"),
              typed);
    EXPECT_TRUE(of_toml("system = []\n").empty());
    EXPECT_TRUE(of_json("[]").empty());
}

TEST(SystemOptions, OfATransitionAreTables) {
    const WeatherConfig weather = parse_weather(
        "[[system]]\nheight = 1\n[[change]]\nfrom = 0\nover = 9\n[[change.system]]\nheight = 2\n"
        "[[change.system]]\nfrom = \"W\"\n[[change]]\nsystem = []\n",
        "weather.toml", keys_of_seas);
    EXPECT_EQ(wave_systems_of(weather.first.at(0)), parse_wave_systems({"height=1"}));
    ASSERT_EQ(weather.changes.size(), 2u);
    const auto systems_in = [](const WeatherConfig::Change& change) {
        for (const ConfigEntry& entry : change.entries)
            if (entry.key == list_key) return wave_systems_of(entry);
        return std::vector<WaveSystem>(1);
    };
    EXPECT_EQ(systems_in(weather.changes[0]), parse_wave_systems({"height=2", "from=W"}));
    EXPECT_TRUE(systems_in(weather.changes[1]).empty());
}

TEST(SystemOptions, AreWrittenAsTheyAreRead) {
    for (const char* text :
         {"height=1.2 period=12 spread=15", "spreading=hasselmann direction=-123.456789",
          "spectrum=phillips wind_speed=7.25 fetch=12345.678 peak_enhancement=1", "spectrum=jonswap"}) {
        const std::vector<WaveSystem> systems = parse_wave_systems({text});
        EXPECT_EQ(text_of(systems[0]), text);
        EXPECT_EQ(parse_wave_systems({text_of(systems[0])}), systems);
    }
}

TEST(SystemOptions, KeepTheBitsOfAnglesInDegrees) {
    for (int i = 0; i < 2000; ++i) {
        const double degrees = -360 + 0.3600000123 * i, radians = degrees * (half_turn / 180);
        const WaveSystem system{.direction_rad = radians};
        EXPECT_EQ(parse_wave_systems({text_of(system)})[0].direction_rad, radians) << degrees;
    }
}

TEST(SystemOptions, OfWrongInputAreRefusedInOneLine) {
    const auto typed = [](const std::string& text) { return message_of([&] { parse_wave_systems({text}); }); };
    EXPECT_EQ(typed("height=-1"), "--system \"height=-1\": height -1 is out of range (0, 30]");
    EXPECT_EQ(typed("heigth=1"),
              "--system \"heigth=1\": unknown key heigth, expected spectrum, spreading, wind_speed, fetch, height, "
              "period, peak_enhancement, direction, spread, from or towards (the nearest is height)");
    EXPECT_EQ(typed("period=0"),
              "--system \"period=0\": period 0 is out of range [1, 40] s, or with a unit such as 4s, 2min");
    EXPECT_EQ(typed("height=nan"), "--system \"height=nan\": height nan is out of range (0, 30]");
    EXPECT_EQ(typed("spread=90"), "--system \"spread=90\": spread is 90, expected degrees in [1, 80]");
    EXPECT_EQ(typed("from=from-W"),
              "--system \"from=from-W\": from is from-W, expected degrees in [-360, 360], or one of 16 points such as "
              "NW");
    EXPECT_EQ(typed("height=1 height=2"),
              "--system \"height=1 height=2\": height is given after height, expected one of the two");
    EXPECT_EQ(typed("from=W direction=3"),
              "--system \"from=W direction=3\": direction is given after from, expected one of the two");
    EXPECT_EQ(typed("1.2"),
              "--system \"1.2\": 1.2 has no value, expected words such as height=1.2 period=12 from=W spread=15");
    EXPECT_EQ(typed(""), "--system \"\" is empty, expected words such as height=1.2 period=12 from=W spread=15");
    EXPECT_EQ(message_of([] { parse_wave_systems(std::vector<std::string>(9, "height=1")); }),
              "--system is given 9 times, expected at most 8");
    EXPECT_EQ(message_of([] { parse_wave_systems(std::vector<std::string>(8, "height=1")); }), "accepted");

    const auto toml = [](const std::string& text) { return message_of([&] { of_toml(text); }); };
    EXPECT_EQ(toml("[[system]]\nheight = \"1.2\"\n"),
              "sea.toml:2: height is \"1.2\", expected a number without quotes: (0, 30]");
    EXPECT_EQ(toml("[system]\nheight = 1\n"), "sea.toml:1: system is no table, expected lines [[system]]");
    EXPECT_EQ(toml("system = 3\n"), "sea.toml:1: system is no table, expected lines [[system]]");
    EXPECT_EQ(toml("[[system]]\nheight = [1]\n"), "sea.toml:2: height is of type array, expected a number or a text");
    const auto json = [](const std::string& text) { return message_of([&] { of_json(text); }); };
    EXPECT_EQ(json("[{\"height_m\": 40}]"), "sea.json: sea.systems: height_m 40 is out of range (0, 30]");
    EXPECT_EQ(json("[{\"from\": 40}]"),
              "sea.json: sea.systems: unknown key from, expected spectrum, spreading, wind_speed_mps, fetch_m, "
              "height_m, peak_period_s, peak_enhancement, direction_deg or spread_deg");
    EXPECT_EQ(json("[3]"), "sea.json: sea: systems is no list of objects, expected a sea.json of pelagic export");
    EXPECT_EQ(json("3"), "sea.json: sea: systems is no list of objects, expected a sea.json of pelagic export");
}

}  // namespace
}  // namespace pelagic::tools
