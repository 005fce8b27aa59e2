// `--regular` of the command line.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/tests/run_pelagic.hpp"

namespace pelagic {
namespace {

nlohmann::json sea_of(std::vector<std::string> words) {
    words.insert(words.begin(), {"info", "--json"});
    const Outcome outcome = run_pelagic(words);
    EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
    return nlohmann::json::parse(outcome.out).at("sea");
}

TEST(RegularCommand, SetsTheWaveAndALoopOfWholePeriods) {
    const auto sea = sea_of({"--regular", "height=1.5 period=7 direction=from-W", "--order", "2"});
    EXPECT_EQ(sea.at("waves"), "regular");
    EXPECT_EQ(sea.at("regular_height_m"), 1.5);
    EXPECT_EQ(sea.at("regular_period_s"), 7);
    EXPECT_EQ(sea.at("wind_direction_deg"), 0);
    EXPECT_EQ(sea.at("order"), 2);
    EXPECT_EQ(sea.at("loop_period_s"), 3598);
    EXPECT_EQ(sea.at("cascades"), 1);
    EXPECT_EQ(sea_of({"--regular", "period=7", "--loop-period", "14"}).at("loop_period_s"), 14);
    EXPECT_EQ(sea_of({"--waves", "regular", "--regular-period", "11"}).at("loop_period_s"), 3597);
}

TEST(RegularCommand, RejectsInvalidWaves) {
    const std::string words = "words of height=METRES, period=SECONDS and direction=HEADING";
    using Words = std::vector<std::string>;
    for (const auto& [flags, message] : {
             std::pair<Words, std::string>{{"--regular", "hight=2"}, "--regular is hight=2, expected " + words},
             {{"--regular", "2 8"}, "--regular is 2, expected " + words},
             {{"--regular", " "}, "--regular is  , expected " + words},
             {{"--regular", "height=x"}, "--regular height x is out of range (0, 60]"},
             {{"--regular", "height=20"},
              "--regular-height is 20, expected at most 14.18 for a wave of 99.89 m at order 1"},
             {{"--regular", "period=8", "--loop-period", "100"},
              "--loop-period is 100, expected a whole number of --regular-period, such as 104"},
             {{"--regular", "period=8", "--waves", "pond"}, "--regular cannot be combined with --waves"},
             {{"--regular", "period=8", "--fetch", "1000"}, "--fetch is 1000; it requires --waves spectrum"},
             {{"--order", "2"}, "--order is 2; it requires --waves regular"},
             {{"--regular", "period=8", "--order", "3"}, "--order is 3, expected 1 or 2"}}) {
        Words all = {"info"};
        all.insert(all.end(), flags.begin(), flags.end());
        const Outcome outcome = run_pelagic(all);
        EXPECT_EQ(outcome.exit_code, 2) << message;
        EXPECT_EQ(outcome.err, "pelagic: " + message + "\n");
    }
}

}  // namespace
}  // namespace pelagic
