// --weather: a file of seas and times, its errors, and the export record that reproduces it.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/run_pelagic.hpp"

namespace pelagic {
namespace {

const std::string calm_to_storm =
    "preset = \"calm\"\nresolution = 32\nseed = 3\n[[change]]\nfrom = 1\nover = 4\npreset = \"storm\"\n"
    "[[change]]\nfrom = 5\nover = 2\nwind_direction = 90\n";

class WeatherCommand : public testing::Test {
   protected:
    nlohmann::json exported(const std::string& weather, const std::string& name, const Arguments& more = {}) {
        const Outcome outcome = run_pelagic(joined({"export", "--out", (folder_ / name).string(), "--frames", "3",
                                                    "--fps", "0.5", "--maps", "displacement", "--weather", weather},
                                                   more));
        EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
        return nlohmann::json::parse(read_file(folder_ / name / "sea.json"));
    }
    std::string file(const std::string& text) {
        write_file(folder_ / "weather.toml", text);
        return (folder_ / "weather.toml").string();
    }
    std::string invalid_value_of(const std::string& text, const Arguments& more = {}) {
        const Outcome outcome = run_pelagic(joined({"info", "--weather", file(text)}, more));
        EXPECT_NE(outcome.exit_code, 0);
        return outcome.err;
    }
    TemporaryFolder folder_;
};

TEST_F(WeatherCommand, ShortWavesThatTheCascadesLeaveOutAreNoted) {
    const std::string weather = file("preset = \"calm\"\n[[change]]\nfrom = 1\nover = 4\npreset = \"beaufort-12\"\n");
    write_file(folder_ / "points.csv", "1,2\n");
    const std::string says = "hold no waves shorter than ";
    const Outcome table = run_pelagic({"info", "--weather", weather});
    EXPECT_NE(table.out.find(says), std::string::npos) << table.out;
    const Outcome json = run_pelagic({"info", "--json", "--weather", weather});
    EXPECT_NE(nlohmann::json::parse(json.out).at("warnings").dump().find(says), std::string::npos) << json.out;
    const Outcome query =
        run_pelagic({"query", "--points", (folder_ / "points.csv").string(), "--weather", weather});
    EXPECT_NE(query.err.find(says), std::string::npos) << query.err;
    EXPECT_NE(exported(weather, "noted").at("warnings").dump().find(says), std::string::npos);
}

TEST_F(WeatherCommand, ExportHasTheFramesOfTheForecastAndItsRecordReproducesIt) {
    const nlohmann::json record = exported(file(calm_to_storm), "first");
    SeaState calm = sea_preset_named("calm")->sea, storm = sea_preset_named("storm")->sea;
    calm.resolution = storm.resolution = 32;
    calm.loop_period_s = storm.loop_period_s = 200;  // of exports
    calm.seed = storm.seed = 3;
    SeaState turned = storm;
    turned.wind_direction_rad = 90 * (3.14159265358979323846 / 180);
    Ocean ocean({.first = calm,
                 .changes = {{.sea = storm, .from_s = 1, .over_s = 4}, {.sea = turned, .from_s = 5, .over_s = 2}}});
    for (const nlohmann::json& frame : record.at("frames")) {
        char text[17];
        std::snprintf(text, sizeof text, "%016llx",
                      static_cast<unsigned long long>(hash_of(ocean.frame_at(frame.at("time_s")))));
        EXPECT_EQ(frame.at("hash"), text) << frame.at("time_s");
    }
    EXPECT_EQ(exported((folder_ / "first" / "sea.json").string(), "second"), record);
    EXPECT_EQ(exported(file(calm_to_storm), "first", {"--resume"}), record);
}

TEST_F(WeatherCommand, SwellMayComeFromADistance) {
    const std::string text =
        "preset = \"calm\"\nresolution = 32\n[[change]]\nfrom = -100\nover = 20\nswell_height = 2\n";
    const nlohmann::json record = exported(file(text + "swell_from = 1000\n"), "afar");
    EXPECT_EQ(record.at("weather").at(0).at("swell_from_m"), 1000);
    EXPECT_EQ(exported((folder_ / "afar" / "sea.json").string(), "again"), record);
    const nlohmann::json near = exported(file(text), "near");
    EXPECT_FALSE(near.at("weather").at(0).contains("swell_from_m"));
    EXPECT_NE(near.at("frames"), record.at("frames"));
}

TEST_F(WeatherCommand, HasAtMostAThousandChanges) {
    const auto weather_of = [](int changes) {
        std::string text = "resolution = 16\n";
        for (int i = 0; i < changes; ++i)
            text += "[[change]]\nfrom = " + std::to_string(i) +
                    "\nover = 0.5\nwind_speed = " + std::to_string(5 + i % 9) + "\n";
        return text;
    };
    EXPECT_EQ(invalid_value_of(weather_of(1001)), "pelagic: " + (folder_ / "weather.toml").string() +
                                                      " is a forecast of 1001 changes, expected at most 1000\n");
    write_file(folder_ / "points.csv", "0,0\n");
    const Outcome max = run_pelagic({"query", "--points", (folder_ / "points.csv").string(), "--time", "900",
                                     "--weather", file(weather_of(1000))});
    EXPECT_EQ(max.exit_code, 0) << max.err;
}

TEST_F(WeatherCommand, ErrorsAreOneLineThatNamesThePosition) {
    EXPECT_NE(invalid_value_of("[[change]]\nfrom = 1\n").find("weather.toml:1: over is missing"), std::string::npos);
    EXPECT_NE(invalid_value_of("[[change]]\nover = 1\n").find("from is missing"), std::string::npos);
    EXPECT_NE(invalid_value_of("[[change]]\nfrom = 1\nover = 1\nwind_sped = 3\n").find("unknown key wind_sped"),
              std::string::npos);
    EXPECT_NE(
        invalid_value_of("[[change]]\nfrom = 1\nover = 1\ndepth = 3\n").find("change 1: depth is 3, expected 4000"),
        std::string::npos);
    EXPECT_NE(invalid_value_of("[[change]]\nfrom = 1\nover = 1\nswell_from = 5e6\nswell_height = 0\n")
                  .find("change 1: swell_from is 5000000, expected none where the sea has no swell"),
              std::string::npos);
    EXPECT_NE(invalid_value_of("[[change]]\nfrom = 1\nover = 0\n").find("change 1: over 0 is out of range (0, 1e9]"),
              std::string::npos);
    EXPECT_NE(invalid_value_of("[[change]]\nfrom = 2\nover = 1\n[[change]]\nfrom = 1\nover = 1\n")
                  .find("change 2: from is 1, expected at least 3"),
              std::string::npos);
    EXPECT_NE(invalid_value_of("[[change]]\nfrom = 1\nover = 1\nswell_from = 3e7\n")
                  .find("swell_from is 30000000, expected metres"),
              std::string::npos);
    EXPECT_NE(invalid_value_of("[[change]]\nfrom = \"5\"\nover = 1\n")
                  .find("weather.toml:2: from is \"5\", expected a number without quotes: seconds in [-1e9, 1e9]"),
              std::string::npos);
    EXPECT_NE(invalid_value_of("[[change]]\nfrom = 5\nover = \"1\"\n")
                  .find("over is \"1\", expected a number without quotes"),
              std::string::npos);
    EXPECT_NE(invalid_value_of("[[change]]\nfrom = 5\nover = 1\nswell_from = \"2e3\"\n")
                  .find("swell_from is \"2e3\", expected a number without quotes"),
              std::string::npos);
    EXPECT_NE(invalid_value_of("change = 3\n").find("expected lines [[change]]"), std::string::npos);
    nlohmann::json record = exported(file(calm_to_storm), "record");  // has the names of fields
    record["weather"][1]["from_s"] = 2;
    EXPECT_NE(invalid_value_of(record.dump()).find("change 2: from_s is 2, expected at least 5"), std::string::npos);
    EXPECT_NE(invalid_value_of(calm_to_storm, {"--config", file(calm_to_storm)}).find("give one of the two"),
              std::string::npos);
}

}  // namespace
}  // namespace pelagic
