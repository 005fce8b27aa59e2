// Presets: the files that users copy, the library's sea states, and the published heights that they
// stand for.
#include <gtest/gtest.h>

#include <CLI/App.hpp>
#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "pelagic/sim/statistics.hpp"
#include "pelagic/tests/test_paths.hpp"
#include "pelagic/tools/options/sea_scales.hpp"
#include "pelagic/tools/record/sea_json.hpp"

namespace pelagic::tools {
namespace {

ResolvedSea resolved(const std::string& flag, const std::string& value) {
    CLI::App app;
    SeaOptions options;
    options.add_to(app);
    app.parse(std::vector<std::string>{value, flag});  // CLI11 takes the arguments in reverse order
    return options.resolve();
}

std::filesystem::path file_of(const SeaPreset& preset) {
    return std::filesystem::path(in_sources("presets")) / (std::string(preset.name) + ".toml");
}

TEST(Presets, FilesMatchTheSeasOfTheirNames) {
    for (const SeaPreset& preset : sea_presets()) {
        const ResolvedSea named = resolved("--preset", std::string(preset.name));
        EXPECT_EQ(sea_as_json(resolved("--config", file_of(preset).string())), sea_as_json(named)) << preset.name;
        // The file's angles are in degrees, the library's in radians: bit-identical. The command
        // prints values that it chooses itself.
        const SeaState from_file = resolved("--config", file_of(preset).string()).sea;
        for (const SeaStateField& field : sea_state_fields())
            if (const SeaAngle* angle = sea_angle(field.name)) {
                EXPECT_EQ(from_file.*angle->radians, preset.sea.*angle->radians) << preset.name << ": " << field.name;
            }
        ResolvedSea in_library = named;
        in_library.sea = preset.sea;
        in_library.sea.cascades = cascades_of(preset.sea);
        in_library.sea.resolution = resolution_of(preset.sea);
        EXPECT_EQ(sea_as_json(in_library), sea_as_json(named)) << preset.name;
        EXPECT_EQ(sea_preset_named(preset.name), &preset);
    }
    const auto files = std::distance(std::filesystem::directory_iterator(in_sources("presets")), {});
    EXPECT_EQ(static_cast<std::size_t>(files), sea_presets().size());
    EXPECT_EQ(sea_preset_named("Storm"), nullptr);
    EXPECT_EQ(sea_preset_named(""), nullptr);
}

TEST(Presets, AreValidAndHaveNoWarnings) {
    for (const SeaPreset& preset : sea_presets()) {
        EXPECT_EQ(check(preset.sea), "") << preset.name;
        EXPECT_EQ(warnings_about(preset.sea), std::vector<std::string>()) << preset.name;
    }
}

TEST(Presets, SummariesContainTheHeightAndTheSeaState) {
    for (const SeaPreset& preset : sea_presets()) {
        const std::string summary(preset.summary);
        const auto at = summary.find("Hs ");
        ASSERT_NE(at, std::string::npos) << preset.name;
        double height = 0;
        int state = 0;
        ASSERT_EQ(std::sscanf(summary.c_str() + at, "Hs %lf m (sea state %d)", &height, &state), 2) << summary;
        const double expected = expected_waves(preset.sea).significant_wave_height_m;
        EXPECT_NEAR(expected, height, 0.05 * height) << summary << ": one or two digits";
        EXPECT_EQ(sea_state_of(expected).number, state) << summary;
    }
}

TEST(Presets, AreOrderedFromMildToRoughWithForcesLast) {
    const auto presets = sea_presets();
    const auto is_force = [](const SeaPreset& preset) { return preset.name.starts_with("beaufort-"); };
    const auto forces = std::find_if(presets.begin(), presets.end(), is_force);
    EXPECT_TRUE(std::all_of(forces, presets.end(), is_force));
    EXPECT_EQ(presets.end() - forces, 13);
    const auto lower = [](const SeaPreset& a, const SeaPreset& b) {
        return expected_waves(a.sea).significant_wave_height_m < expected_waves(b.sea).significant_wave_height_m;
    };
    EXPECT_TRUE(std::is_sorted(presets.begin(), forces, lower));
    EXPECT_TRUE(std::is_sorted(forces, presets.end(), lower));
}

// Probable wave heights of the open sea, in metres, by Beaufort force (World Meteorological
// Organization). The table's 0.1 m for light air is a rounded ripple, and calm has no waves.
TEST(Presets, ForcesHaveTheirWindAndProbableHeights) {
    const double probable[] = {0, 0.1, 0.2, 0.6, 1, 2, 3, 4, 5.5, 7, 9, 11.5, 14};
    for (int force = 0; force <= 12; ++force) {
        const SeaPreset* preset = sea_preset_named("beaufort-" + std::to_string(force));
        ASSERT_NE(preset, nullptr) << force;
        EXPECT_EQ(beaufort_of(preset->sea.wind_speed_mps).number, force);
        const double height = *expected_waves(preset->sea).model_significant_wave_height_m;
        EXPECT_NEAR(height, probable[force], std::max(0.05, 0.05 * probable[force])) << preset->name;
    }
}

}  // namespace
}  // namespace pelagic::tools
