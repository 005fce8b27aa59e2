// Whole frames through the public interface, compared with the oracle.
#include <half.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <string>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface/cascade_sum.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/message_of.hpp"
#include "pelagic/tests/oracle/gradient_oracle.hpp"
#include "pelagic/tests/oracle/sea_oracle.hpp"

namespace pelagic {
namespace {

Ocean ocean_on(const SeaState& sea, Isa isa) { return Ocean(sea, {.executor = make_serial_executor(), .isa = isa}); }

struct Case {
    std::string name;
    SeaState sea;
    double time_s;
};

void PrintTo(const Case& one, std::ostream* out) { *out << one.name; }

std::vector<Case> cases() {
    return {
        {"N16", {.resolution = 16, .patch_size_m = 250}, 1.5},
        {"N32", {.resolution = 32, .patch_size_m = 250, .wind_direction_rad = 2.5}, 17.25},
        {"N64", {.resolution = 64, .patch_size_m = 250}, 0},
        {"N64_later", {.resolution = 64, .patch_size_m = 250, .wind_direction_rad = -1}, 143.7},
        {"N64_lambda_0", {.resolution = 64, .patch_size_m = 250, .choppiness = 0}, 3},
        {"N64_lambda_1_odd_patch", {.resolution = 64, .patch_size_m = 37.3, .wind_speed_mps = 6, .choppiness = 1}, 3},
        {"N64_paper", {.spectrum = SpectrumModel::phillips_paper, .resolution = 64, .patch_size_m = 250}, 5},
        {"N64_phillips",
         {.spectrum = SpectrumModel::phillips, .resolution = 64, .patch_size_m = 250, .wind_alignment = 0},
         5},
        {"N64_pierson",
         {.spectrum = SpectrumModel::pierson_moskowitz, .resolution = 64, .patch_size_m = 250, .wind_alignment = 1},
         5},
        {"N64_small_waves_shallow",
         {.resolution = 64, .patch_size_m = 250, .depth_m = 5, .short_wave_cutoff = 0.5},
         5},
        {"N64_phillips_shallow",
         {.spectrum = SpectrumModel::phillips, .resolution = 64, .patch_size_m = 60, .depth_m = 6},
         5},
        {"N64_breaking", {.resolution = 64, .patch_size_m = 250, .depth_m = 1.5, .swell_height_m = 1}, 5},
        {"N64_swell",
         {.resolution = 64,
          .patch_size_m = 600,
          .wind_speed_mps = 4,
          .swell_height_m = 3,
          .swell_period_s = 11,
          .swell_direction_rad = 2,
          .swell_spread_rad = 0.4},
         5},
        {"N64_cosine_2s",
         {.spreading = SpreadingModel::cosine_2s, .resolution = 64, .patch_size_m = 250, .wind_direction_rad = 1},
         5},
        {"N64_hasselmann",
         {.spreading = SpreadingModel::hasselmann, .resolution = 64, .patch_size_m = 250, .wind_direction_rad = -2},
         5},
        {"N64_donelan_banner",
         {.spreading = SpreadingModel::donelan_banner, .resolution = 64, .patch_size_m = 60},
         5},
        {"N64_short_loop", {.resolution = 64, .patch_size_m = 250, .loop_period_s = 3.7}, 1.1},
        {"N256", {.resolution = 256, .patch_size_m = 250}, 12.34},
        {"N256_storm",
         {.resolution = 256, .patch_size_m = 1000, .wind_speed_mps = 25, .fetch_m = 5e5, .choppiness = 1},
         77},
    };
}

class FrameOnEachIsa : public testing::TestWithParam<std::tuple<Isa, Case>> {
   protected:
    const Case& one() const { return std::get<Case>(GetParam()); }
    Isa isa() const { return std::get<Isa>(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(
    Seas, FrameOnEachIsa, testing::Combine(testing::ValuesIn(isas_here()), testing::ValuesIn(cases())),
    [](const auto& test) {
        return isa_test_name({std::get<Isa>(test.param), 0}) + "_" + std::get<Case>(test.param).name;
    });

void expect_close(const PlaneView& plane, const oracle::ComplexField& truth, const char* name) {
    double largest = 0, error = 0;
    for (int j = 0; j < plane.resolution; ++j) {
        for (int i = 0; i < plane.resolution; ++i) {
            const double value = truth[static_cast<std::size_t>(j * plane.resolution + i)].real();
            largest = std::max(largest, std::fabs(value));
            error = std::max(error, std::fabs(plane.at(i, j) - value));
        }
    }
    // The specified bound; float rounding is about 3e-7.
    EXPECT_LE(error, 2e-6 * largest) << name;
    testing::Test::RecordProperty(std::string(name) + "_relative_error",
                                  std::to_string(largest > 0 ? error / largest * 1e9 : 0) + "e-9");
}

TEST_P(FrameOnEachIsa, DisplacementMatchesTheOracle) {
    Ocean ocean = ocean_on(one().sea, isa());
    const Frame& frame = ocean.frame_at(one().time_s);
    const oracle::Fields truth = oracle::fields_at(one().sea, one().time_s);
    expect_close(frame.cascades[0].height, truth.height, "height");
    expect_close(frame.cascades[0].dx, truth.dx, "dx");
    expect_close(frame.cascades[0].dz, truth.dz, "dz");
}

TEST_P(FrameOnEachIsa, BoundsAreTheExtremesOfThePlanes) {
    Ocean ocean = ocean_on(one().sea, isa());
    const Frame& frame = ocean.frame_at(one().time_s);
    FrameBounds bounds{.height_min_m = frame.cascades[0].height.at(0, 0),
                       .height_max_m = frame.cascades[0].height.at(0, 0)};
    for (int j = 0; j < frame.cascades[0].resolution(); ++j) {
        for (int i = 0; i < frame.cascades[0].resolution(); ++i) {
            bounds.height_min_m = std::min(bounds.height_min_m, frame.cascades[0].height.at(i, j));
            bounds.height_max_m = std::max(bounds.height_max_m, frame.cascades[0].height.at(i, j));
            bounds.horizontal_x_max_m = std::max(bounds.horizontal_x_max_m, std::fabs(frame.cascades[0].dx.at(i, j)));
            bounds.horizontal_z_max_m = std::max(bounds.horizontal_z_max_m, std::fabs(frame.cascades[0].dz.at(i, j)));
        }
    }
    EXPECT_EQ(frame.bounds.height_min_m, bounds.height_min_m);
    EXPECT_EQ(frame.bounds.height_max_m, bounds.height_max_m);
    EXPECT_EQ(frame.bounds.horizontal_x_max_m, bounds.horizontal_x_max_m);
    EXPECT_EQ(frame.bounds.horizontal_z_max_m, bounds.horizontal_z_max_m);
}

// OpenEXR rounds with Imath's half: to nearest even.
TEST_P(FrameOnEachIsa, HalvesAreTheFloatsRoundedToNearestEven) {
    Ocean ocean = ocean_on(one().sea, isa());
    const Frame& frame = ocean.frame_at(one().time_s);
    for (int j = 0; j < frame.cascades[0].resolution(); ++j) {
        for (int i = 0; i < frame.cascades[0].resolution(); ++i) {
            const std::size_t texel = static_cast<std::size_t>(j * frame.cascades[0].resolution() + i);
            const std::uint16_t* halves = frame.cascades[0].displacement_rgba16f.data() + 4 * texel;
            ASSERT_EQ(halves[0], Imath::half(frame.cascades[0].dx.at(i, j)).bits()) << i << ", " << j;
            ASSERT_EQ(halves[1], Imath::half(frame.cascades[0].height.at(i, j)).bits()) << i << ", " << j;
            ASSERT_EQ(halves[2], Imath::half(frame.cascades[0].dz.at(i, j)).bits()) << i << ", " << j;
            ASSERT_EQ(halves[3], 0) << i << ", " << j;
        }
    }
}

// Rounding may go to either side of a step, so one step is the tightest possible bound. Smoothness
// is steepest at length one, where the length's error of 2e-7 becomes sqrt(3.5 * 2e-7) = 8e-4, or
// 0.2 steps.
TEST_P(FrameOnEachIsa, GradientBytesOfEveryLevelAreWithinOneStepOfEquation50) {
    Ocean ocean = ocean_on(one().sea, isa());
    const Frame& frame = ocean.frame_at(one().time_s);
    const auto levels =
        oracle::levels_of(oracle::displacement_of(frame), one().sea.patch_size_m, frame.statistics.roughness);
    ASSERT_EQ(static_cast<int>(levels.size()), mip_levels(frame.cascades[0].resolution()));
    for (std::size_t m = 0; m < levels.size(); ++m) {
        const auto texels = frame.cascades[0].gradient_level(static_cast<int>(m));
        ASSERT_EQ(texels.size(), levels[m].normal.size());
        for (std::size_t texel = 0; texel < texels.size(); ++texel) {
            const auto expected = oracle::bytes_of(levels[m], texel);
            for (std::size_t c = 0; c < 4; ++c) {
                const double byte = texels[texel] >> 8 * c & 0xFF;
                ASSERT_NEAR(byte, std::floor(expected[c] + 0.5), 1)
                    << "level " << m << " texel " << texel << " byte " << c;
            }
        }
    }
}

TEST(CascadeSum, EqualsTexelsInterpolatesBilinearlyAndRepeats) {
    const double side = 130;
    Ocean ocean = ocean_on({.resolution = 32, .patch_size_m = 130}, choose_isa());
    const Frame& frame = ocean.frame_at(4);
    const double texel = side / 32;
    for (const int patch : {0, 1, -3}) {
        for (int j = 0; j < 32; ++j)
            for (int i = 0; i < 32; ++i) {
                // A texel's position may round to slightly before it; the error is that distance
                // times a slope below 1.
                const Displacement at = displacement_of(frame, i * texel + patch * side, j * texel - patch * side);
                EXPECT_NEAR(at.dx, frame.cascades[0].dx.at(i, j), 1e-9);
                EXPECT_NEAR(at.height, frame.cascades[0].height.at(i, j), 1e-9);
                EXPECT_NEAR(at.dz, frame.cascades[0].dz.at(i, j), 1e-9);
                const Displacement centre =
                    displacement_of(frame, (i + 0.5) * texel + patch * side, (j + 0.5) * texel);
                const int right = (i + 1) % 32, below = (j + 1) % 32;
                const auto mean = [&](const PlaneView& p) {
                    return (double{p.at(i, j)} + p.at(right, j) + p.at(i, below) + p.at(right, below)) / 4;
                };
                EXPECT_NEAR(centre.height, mean(frame.cascades[0].height), 1e-9);
                EXPECT_NEAR(centre.dz, mean(frame.cascades[0].dz), 1e-9);
            }
    }
}

TEST(MipChain, OffsetsAreARunningSumOfTexels) {
    for (int n = 1; n <= 4096; n *= 2) {
        std::size_t sum = 0;
        int level = 0;
        for (int side = n; side >= 1; side /= 2, ++level) {
            EXPECT_EQ(mip_offset(n, level), sum) << n << " level " << level;
            sum += static_cast<std::size_t>(side) * side;
        }
        EXPECT_EQ(mip_levels(n), level);
        EXPECT_EQ(mip_offset(n, level), sum) << n << " whole chain";
    }
}

TEST(Ocean, InvalidOptionsThrowTheMessageOfCheck) {
    const SeaState bad{.wind_speed_mps = -3};
    EXPECT_EQ(message_of([&] { Ocean ocean(bad); }), "wind_speed_mps -3 is out of range (0, 60]");
    Ocean ocean(SeaState{.resolution = 16, .patch_size_m = 250});
    EXPECT_THROW(ocean.schedule_sea(SeaState{.resolution = 32, .patch_size_m = 250}), std::invalid_argument);
    EXPECT_THROW(ocean.schedule_sea(bad), std::invalid_argument);
}

TEST(Ocean, EveryPresetIsValid) {
    for (const SeaPreset& preset : sea_presets()) EXPECT_EQ(check(preset.sea), "") << preset.name;
}

}  // namespace
}  // namespace pelagic
