// Whole frames through the public interface, compared with the oracle.
#include <half.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <deque>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <tuple>
#include <vector>

#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/sim/ocean.hpp"
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
        {"N64_lean", {.resolution = 64, .patch_size_m = 250, .wind_direction_rad = 2, .lean = 0.4}, 5},
        {"N64_lean_shallow",
         {.resolution = 64, .patch_size_m = 250, .depth_m = 5, .choppiness = 1, .lean = 0.6},
         143.7},
        {"N64_lean_and_swell",
         {.resolution = 64,
          .patch_size_m = 600,
          .wind_speed_mps = 10,
          .lean = 0.5,
          .swell_height_m = 3,
          .swell_direction_rad = 2},
         5},
        {"N64_lean_paper",
         {.spectrum = SpectrumModel::phillips_paper, .resolution = 64, .patch_size_m = 250, .lean = 0.4},
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

/// A frame of two cascades, one of them rotated, with one long wave each:
///
///   h = a cos(k . x),  D = -a k / |k| sin(k . x)
class TwoWaves {
   public:
    static constexpr int n = 64;
    static constexpr float compression_scale = 0.7f, front_x = 0.25f, front_z = -0.5f;
    /// Phase change of a wave between two texels.
    static constexpr double turn = 2 * std::numbers::pi / n;

    TwoWaves() {
        for (const auto& [side_m, cosine, sine, along, across, amplitude_m] :
             {std::tuple(100.0, 1.0, 0.0, 1, 0, 1.5), {37.0, 0.6, 0.8, 1, 1, 0.4}}) {
            Cascade& cascade = cascades_.emplace_back();
            cascade.grid = {.side_m = side_m, .cosine = cosine, .sine = sine};
            cascade.compression_scale = compression_scale;
            cascade.compression_front_x = front_x;
            cascade.compression_front_z = front_z;
            const double per_m = 2 * std::numbers::pi / side_m;
            const auto [k_x, k_z] = cascade.grid.in_world(per_m * along, per_m * across);
            waves_.push_back({amplitude_m, k_x, k_z});
            for (PlaneView* plane : {&cascade.dx, &cascade.height, &cascade.dz}) {
                std::vector<float>& texels = planes_.emplace_back();
                for (int j = 0; j < n; ++j)
                    for (int i = 0; i < n; ++i) {
                        const auto [x, z] = cascade.grid.in_world(i * side_m / n, j * side_m / n);
                        const Wave& wave = waves_.back();
                        const double phase = k_x * x + k_z * z, k = std::hypot(k_x, k_z);
                        texels.push_back(static_cast<float>(
                            plane == &cascade.height
                                ? wave.amplitude_m * std::cos(phase)
                                : -wave.amplitude_m * (plane == &cascade.dx ? k_x : k_z) / k * std::sin(phase)));
                    }
                *plane = {
                    .data = texels.data(), .resolution = n, .block_columns = n, .row_stride = n, .block_stride = 0};
            }
        }
        frame_.cascades = cascades_;
    }
    const Frame& frame() const { return frame_; }

    /// Returns the derivatives of the sum in closed form.
    SurfaceSlopes slopes(double x, double z) const {
        SurfaceSlopes sum;
        for (const Wave& wave : waves_) {
            const double phase = wave.k_x * x + wave.k_z * z, k = std::hypot(wave.k_x, wave.k_z);
            const double tilt = -wave.amplitude_m * std::sin(phase),
                         stretch = -wave.amplitude_m / k * std::cos(phase);
            sum += {.h_x = wave.k_x * tilt,
                    .h_z = wave.k_z * tilt,
                    .d_xx = wave.k_x * wave.k_x * stretch,
                    .d_zz = wave.k_z * wave.k_z * stretch,
                    .d_xz = wave.k_x * wave.k_z * stretch};
        }
        return sum;
    }
    /// Returns the sum of the largest slopes of both waves.
    double max_slope() const {
        double sum = 0;
        for (const Wave& wave : waves_) sum += wave.amplitude_m * std::hypot(wave.k_x, wave.k_z);
        return sum;
    }

   private:
    struct Wave {
        double amplitude_m, k_x, k_z;
    };
    std::vector<Wave> waves_;
    std::deque<std::vector<float>> planes_;
    std::vector<Cascade> cascades_;
    Frame frame_;
};

TEST(CascadeSum, SlopesJacobianAndCompressionAreThoseOfTheWaves) {
    const TwoWaves waves;
    // The differences amplify a wave of phase change t a texel by at most 0.28 t^2 along each axis,
    // and bilinear interpolation attenuates it by at most t^2 / 8 (first terms of their series).
    // Rounding of the texels to floats is far less.
    const double bound = 2 * 0.28 * TwoWaves::turn * TwoWaves::turn * waves.max_slope();
    for (int i = 0; i < 400; ++i) {
        const double x = 1.37 * i - 200, z = 311.1 - 0.83 * i;
        const SurfaceSlopes expected = waves.slopes(x, z), found = slopes_of(waves.frame(), x, z);
        EXPECT_NEAR(found.h_x, expected.h_x, bound);
        EXPECT_NEAR(found.h_z, expected.h_z, bound);
        EXPECT_NEAR(found.d_xx, expected.d_xx, bound);
        EXPECT_NEAR(found.d_zz, expected.d_zz, bound);
        EXPECT_NEAR(found.d_xz, expected.d_xz, bound);
        // The Jacobian has two products of sums below 1 + max_slope().
        EXPECT_NEAR(jacobian_of(waves.frame(), x, z),
                    (1 + expected.d_xx) * (1 + expected.d_zz) - expected.d_xz * expected.d_xz,
                    4 * bound * (1 + waves.max_slope()));
        EXPECT_NEAR(compression_of(waves.frame(), x, z),
                    -double{TwoWaves::compression_scale} *
                        (expected.d_xx + expected.d_zz + double{TwoWaves::front_x} * expected.h_x +
                         double{TwoWaves::front_z} * expected.h_z),
                    3 * bound);
    }
}

TEST(CascadeSum, SlopesAndCompressionAreThoseOfTheTextures) {
    const SeaState sea{
        .cascades = 3, .resolution = 32, .wind_speed_mps = 15, .wind_direction_rad = 2, .lean = 0.4};
    Ocean ocean(sea, {.executor = make_serial_executor(), .slopes = true, .foam = true});
    const Frame& frame = ocean.frame_at(4);
    for (const Cascade& cascade : frame.cascades) {
        const std::span<const std::uint32_t> slopes = cascade.level_of(cascade.slopes_rgba8, 0),
                                             moments = cascade.level_of(cascade.moments_rgba8, 0);
        Frame alone = frame;
        alone.cascades = {&cascade, 1};
        // Half a step of a byte, and the rounding of floats and of positions.
        const double half_step = double{cascade.slope_ranges.slope} / 127 / 2 * 1.001;
        for (int j = 0; j < 32; ++j)
            for (int i = 0; i < 32; ++i) {
                const auto [x, z] = cascade.grid.in_world(i * cascade.texel_m(), j * cascade.texel_m());
                const auto texel = static_cast<std::size_t>(j * 32 + i);
                const SurfaceSlopes stored = slopes_of_texel(slopes[texel], moments[texel], cascade.slope_ranges);
                const SurfaceSlopes found = slopes_of(cascade, x, z);
                const double range = cascade.slope_ranges.slope, lowest = -range * 128 / 127;
                EXPECT_NEAR(std::clamp(found.h_x, lowest, range), stored.h_x, half_step);
                EXPECT_NEAR(std::clamp(found.h_z, lowest, range), stored.h_z, half_step);
                EXPECT_NEAR(std::clamp(found.d_xx, lowest, range), stored.d_xx, half_step);
                EXPECT_NEAR(std::clamp(found.d_zz, lowest, range), stored.d_zz, half_step);
                EXPECT_NEAR(std::clamp(found.d_xz, lowest, range), stored.d_xz, half_step);
                if (cascade.compression_r8.empty()) continue;
                const double compression = compression_of(alone, x, z);
                EXPECT_NEAR(std::clamp(compression, double{SnapshotFoam::lowest}, 5.0),
                            SnapshotFoam::value_of(cascade.compression_r8[texel]), SnapshotFoam::step / 2 * 1.001f);
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

TEST(FrameContents, MapsHaveDefaultsByTheNumberOfCascadesAndCanBeOnOrOff) {
    const std::optional<bool> none, on = true, off = false;
    const auto are_equal = [](auto a, auto b) { return std::equal(a.begin(), a.end(), b.begin(), b.end()); };
    struct Row {
        int cascades;
        std::optional<bool> gradients, slopes;
        bool foam, has_gradients, has_slopes;
    };
    for (const Row& row : {Row{1, none, none, false, true, false},
                           {1, none, none, true, true, true},
                           {1, none, on, false, true, true},
                           {1, off, none, false, false, true},
                           {1, none, off, false, true, false},
                           {2, none, none, false, false, true},
                           {2, none, none, true, false, true},
                           {2, on, none, false, true, true},
                           {2, none, off, false, true, false},
                           {2, on, off, false, true, false}}) {
        const SeaState sea{.cascades = row.cascades, .resolution = 64};
        Ocean reference(sea,
                        {.executor = make_serial_executor(), .gradients = true, .slopes = true, .foam = row.foam});
        const Frame& expected = reference.frame_at(3);
        for (const bool planes : {true, false}) {
            SCOPED_TRACE(std::to_string(row.cascades) + " cascades, " + testing::PrintToString(row.gradients) + ", " +
                         testing::PrintToString(row.slopes));
            Ocean ocean(sea, {.executor = make_serial_executor(),
                              .gradients = row.gradients,
                              .slopes = row.slopes,
                              .foam = row.foam,
                              .planes = planes});
            EXPECT_EQ(ocean.contents().gradients, row.has_gradients);
            EXPECT_EQ(ocean.contents().slopes, row.has_slopes);
            const Frame& frame = ocean.frame_at(3);
            for (std::size_t i = 0; i < frame.cascades.size(); ++i) {
                const Cascade &cascade = frame.cascades[i], &all = expected.cascades[i];
                EXPECT_TRUE(are_equal(cascade.displacement_rgba16f, all.displacement_rgba16f));
                EXPECT_TRUE(row.has_gradients ? are_equal(cascade.gradient_rgba8, all.gradient_rgba8)
                                              : cascade.gradient_rgba8.empty());
                EXPECT_TRUE(row.has_slopes ? are_equal(cascade.slopes_rgba8, all.slopes_rgba8)
                                           : cascade.slopes_rgba8.empty());
            }
        }
    }
    const auto refusal = [](const OceanOptions& options) {
        return message_of([&] { Ocean({.resolution = 16}, options); });
    };
    EXPECT_EQ(refusal({.gradients = false, .slopes = false}),
              "gradients and slopes are off, expected one of them on");
    EXPECT_EQ(refusal({.slopes = false, .foam = true}), "foam cannot be combined with an ocean without slopes");
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
