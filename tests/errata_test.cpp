// Values that docs/errata.md states about the paper's equations 45 to 50, and the normal of a
// wave with a known solution.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface/surface_appearance.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/oracle/gradient_oracle.hpp"
#include "pelagic/tests/oracle/sea_oracle.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;

// The mean normal of a GGX surface of roughness 1 (alpha = 1). Its distribution is D = 1/pi,
// weighted with cos(theta) over the hemisphere; the mean of cos(theta) is the integral of D cos^2,
// which is 2/3.
TEST(Errata, MeanNormalLengthAtRoughnessOneIsTwoThirds) {
    constexpr int steps = 100000;
    double mean = 0;
    for (int i = 0; i < steps; ++i) {
        const double cosine = (i + 0.5) / steps;  // uniform in solid angle
        mean += 2 * pi * (1 / pi) * cosine * cosine / steps;
    }
    EXPECT_NEAR(mean, 2.0 / 3, 1e-9);
    EXPECT_NEAR(mean_normal_length(1), 0.662, 1e-6);
    EXPECT_NEAR(mean_normal_length(1), mean, 0.012);
    EXPECT_EQ(mean_normal_length(0), 1.f);
    for (float r = 0; r < 1; r += 0.01f) EXPECT_GT(mean_normal_length(r), mean_normal_length(r + 0.01f));
}

TEST(Errata, LengthOneByteStepBelowOneGivesSmoothness88Percent) {
    const double length = 1 - 1.0 / 255;
    const double t = (length - 2.0 / 3) * 3;
    EXPECT_NEAR(1 - std::sqrt(1 - t * (0.85 + 0.15 * t)), 0.88, 0.005);
}

// Equation 45, compared with the exact derivative taken in the spectrum.
TEST(Errata, CentralDifferencesLoseATenthOfTheSlope) {
    const SeaState sea{.resolution = 256, .patch_size_m = 250};
    const oracle::Fields fields = oracle::fields_at(sea, 1);
    oracle::Displacement surface{256, {}, {}, {}};
    for (std::size_t i = 0; i < fields.height.size(); ++i) surface.height.push_back(fields.height[i].real());
    double difference = 0, exact = 0;
    for (int j = 0; j < 256; ++j) {
        for (int i = 0; i < 256; ++i) {
            const auto at = [&](int a) {
                return surface.height[static_cast<std::size_t>(j * 256 + (a + 256) % 256)];
            };
            const double slope = (at(i + 1) - at(i - 1)) * 256 / (2 * sea.patch_size_m);
            difference += slope * slope;
        }
    }
    oracle::ComplexField slopes = oracle::spectrum_at(sea, 1);
    for (std::size_t i = 0; i < slopes.size(); ++i)
        slopes[i] *= oracle::Complex(0, 2 * pi / sea.patch_size_m * oracle::wave_number(i % 256, 256));
    for (const oracle::Complex& slope : slopes) exact += std::norm(slope) * static_cast<double>(slopes.size());
    const double lost = 1 - std::sqrt(difference / exact);
    RecordProperty("lost", std::to_string(lost));
    EXPECT_GT(lost, 0.08);
    EXPECT_LT(lost, 0.20);
}

TEST(Errata, NormalsWithoutHorizontalDisplacementAreDegreesOff) {
    const SeaState sea{.resolution = 128, .patch_size_m = 250, .wind_speed_mps = 12, .choppiness = 1};
    Ocean ocean(sea, {.executor = make_serial_executor()});
    const oracle::Displacement surface = oracle::displacement_of(ocean.frame_at(1));
    oracle::Displacement height_only = surface;
    std::fill(height_only.dx.begin(), height_only.dx.end(), 0);
    std::fill(height_only.dz.begin(), height_only.dz.end(), 0);
    const auto full = oracle::levels_of(surface, sea.patch_size_m, 0).front().normal;
    const auto plain = oracle::levels_of(height_only, sea.patch_size_m, 0).front().normal;
    double max = 0;
    for (std::size_t i = 0; i < full.size(); ++i) {
        const double cosine = full[i][0] * plain[i][0] + full[i][1] * plain[i][1] + full[i][2] * plain[i][2];
        max = std::max(max, std::acos(std::min(1.0, cosine)) * 180 / pi);
    }
    RecordProperty("degrees", std::to_string(max));
    EXPECT_GT(max, 3);
}

// One wave h = a cos(kx - phase) displaced horizontally by -lambda a sin: x -> x + Dx gives a
// trochoid, whose tangent along x is (1 + Dx', h', 0). Its normal is (-h', 1 + Dx', 0), normalised.
// Computed by the kernel, on every instruction set.
class NormalOnEachIsa : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(Isas, NormalOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

TEST_P(NormalOnEachIsa, OfOneWaveIsTheTrochoidsNormal) {
    constexpr int n = 256;
    constexpr double patch = 100, amplitude = 2, lambda = 0.9;
    const double k = 2 * pi * 3 / patch;
    const std::size_t lanes = kernels().lanes;
    const std::size_t block_floats = column_block_floats(n, lanes);
    AlignedBuffer<float> surface(column_blocks(n, lanes) * block_floats);
    for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) {
            float* at = surface.data() + i / lanes * block_floats + j * surface_components * lanes + i % lanes;
            const double phase = k * static_cast<double>(i) * patch / n;
            at[surface_dx * lanes] = static_cast<float>(-lambda * amplitude * std::sin(phase));
            at[surface_height * lanes] = static_cast<float>(amplitude * std::cos(phase));
        }
    }
    AlignedBuffer<std::uint32_t> rgba8(n * n);
    AlignedBuffer<std::uint16_t> rgba16f(4 * n * n);
    AlignedBuffer<std::uint32_t> levels(GradientsJob::block_levels * n * n);
    AlignedBuffer<float> averages(n * (mip_planes + 1) * n);
    const double two_texels = 2 * patch / n;
    GradientsJob job{.surface = surface.data(),
                     .resolution = n,
                     .first_row = 0,
                     .first_column = 0,
                     .block_stride = block_floats,
                     .two_texels_m = static_cast<float>(two_texels),
                     .jacobian_factor = static_cast<float>(1 / (two_texels * two_texels)),
                     .normal_length = 1,
                     .smoothness_bits = smoothness_bits(0),
                     .rgba16f = rgba16f.data(),
                     .levels = {rgba8.data()},
                     .averages = averages.data(),
                     .average_stride = n};
    for (std::size_t level = 1; level <= GradientsJob::block_levels; ++level)
        job.levels[level] = levels.data() + (level - 1) * n * n;
    for (; job.first_column < n; job.first_column += GradientsJob::block_columns) kernels().gradients(job);

    // Central differences reduce a slope by sin(k d)/(k d), with texel size d: 1 - 0.0009 here, a
    // fifth of a byte's step.
    const double d = patch / n, shrunk = std::sin(k * d) / (k * d);
    EXPECT_GT(shrunk, 0.999);
    for (int i = 0; i < n; ++i) {
        const double slope = -amplitude * k * std::sin(k * i * d),
                     stretch = 1 - lambda * amplitude * k * std::cos(k * i * d);
        const double length = std::hypot(slope, stretch);
        EXPECT_NEAR(rgba8[static_cast<std::size_t>(i)] & 0xFF, (-slope / length * 0.5 + 0.5) * 255, 1) << i;
        EXPECT_NEAR(rgba8[static_cast<std::size_t>(i)] >> 8 & 0xFF, 127.5, 1) << i;
        EXPECT_NEAR(rgba8[static_cast<std::size_t>(i)] >> 16 & 0xFF, (std::min(1.0, stretch) * 0.5 + 0.5) * 255, 1)
            << i;
        EXPECT_EQ(rgba8[static_cast<std::size_t>(i)] >> 24, 255u);
    }
}

}  // namespace
}  // namespace pelagic
