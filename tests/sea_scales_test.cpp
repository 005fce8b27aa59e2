// Beaufort numbers and sea states, compared with the published limits.
#include <gtest/gtest.h>

#include "pelagic/tools/options/sea_scales.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

TEST(SeaScales, BeaufortNumbersHaveThePublishedLimits) {
    const double last_of[] = {0.2, 1.5, 3.3, 5.4, 7.9, 10.7, 13.8, 17.1, 20.7, 24.4, 28.4, 32.6};
    for (int force = 0; force < 12; ++force) {
        EXPECT_EQ(beaufort_of(last_of[force]).number, force);
        EXPECT_EQ(beaufort_of(last_of[force] + 0.1).number, force + 1);
    }
    EXPECT_EQ(beaufort_of(60).number, 12);
    EXPECT_EQ(beaufort_of(9).name, "fresh breeze");
    for (int force = 1; force <= 12; ++force)
        EXPECT_EQ(beaufort_of(*parse_speed_mps("bft" + std::to_string(force))).number, force) << "what bft means";
}

TEST(SeaScales, SeaStatesHaveThePublishedLimits) {
    const double last_of[] = {0.0, 0.1, 0.5, 1.25, 2.5, 4, 6, 9, 14};
    for (int state = 0; state < 9; ++state) {
        EXPECT_EQ(sea_state_of(last_of[state]).number, state);
        EXPECT_EQ(sea_state_of(last_of[state] + 0.01).number, state + 1);
    }
    EXPECT_EQ(sea_state_of(2).name, "moderate");
    EXPECT_EQ(sea_state_of(30).name, "phenomenal");
}

}  // namespace
}  // namespace pelagic::tools
