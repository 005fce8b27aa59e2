// Stage `evolve` alone, against its equation in double.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

#include "sim/wave_blocks.hpp"
#include "simd/aligned_buffer.hpp"
#include "tests/each_isa.hpp"

namespace pelagic {
namespace {

class EvolveOnEachIsa : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(Isas, EvolveOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

// With S'_xy = (1, 0) and S'_zw = (0, 1) the wave is cos + i sin of its phase. The phase's rounding to a float moves
// it by up to pi/4 2^-24, the polynomials' last two roundings by 2^-24 together: less than a step of 2^-23.
TEST_P(EvolveOnEachIsa, RotationIsWithinOneFloatStepAllAroundTheCircle) {
    constexpr double step = 0x1p-23;
    constexpr std::size_t rows = 4096;
    AlignedBuffer<ModeRow> modes(rows);
    AlignedBuffer<float> waves(rows * wave_row_floats);
    std::mt19937 random(7);
    const auto phase_of = [&](std::size_t i) -> std::uint32_t {
        // Around every eighth of a turn, where the polynomials' range ends, and anywhere.
        if (i < 16 * 64) return static_cast<std::uint32_t>((i / 64 << 28) + i % 64 - 32);
        return static_cast<std::uint32_t>(random());
    };
    for (std::size_t i = 0; i < rows * lane_block; ++i) {
        ModeRow& row = modes[i / lane_block];
        row.cos_re[i % lane_block] = 1;
        row.sin_im[i % lane_block] = 1;
        row.harmonic[i % lane_block] = phase_of(i);
    }
    kernels().evolve({.modes = modes.data(), .count = rows, .fraction = 1, .waves = waves.data()});
    for (std::size_t i = 0; i < rows * lane_block; ++i) {
        const std::size_t row = i / lane_block, lane = i % lane_block;
        const double angle = modes[row].harmonic[lane] * 0x1p-32 * 2 * std::numbers::pi;
        EXPECT_NEAR(waves[row * wave_row_floats + height_re * lane_block + lane], std::cos(angle), step);
        EXPECT_NEAR(waves[row * wave_row_floats + height_im * lane_block + lane], std::sin(angle), step);
    }
}

TEST_P(EvolveOnEachIsa, MatchesItsEquationInDouble) {
    constexpr std::size_t rows = 64;
    constexpr std::uint32_t fraction = 0x12345678;
    AlignedBuffer<ModeRow> modes(rows);
    AlignedBuffer<float> waves(rows * wave_row_floats);
    std::mt19937 random(11);
    std::normal_distribution<float> amplitude;
    for (ModeRow* mode = modes.data(); mode != modes.data() + rows; ++mode) {
        for (std::size_t lane = 0; lane < lane_block; ++lane) {
            for (auto* part : {mode->cos_re, mode->cos_im, mode->sin_re, mode->sin_im})
                part[lane] = amplitude(random);
            const float angle = amplitude(random);
            mode->dir_x[lane] = std::cos(angle);
            mode->dir_z[lane] = std::sin(angle);
            mode->harmonic[lane] = static_cast<std::uint32_t>(random() % 2000);
        }
    }
    kernels().evolve({.modes = modes.data(), .count = rows, .fraction = fraction, .waves = waves.data()});
    for (std::size_t p = 0; p < rows; ++p) {
        for (std::size_t lane = 0; lane < lane_block; ++lane) {
            const ModeRow& mode = modes[p];
            const double angle =
                static_cast<std::uint32_t>(mode.harmonic[lane] * fraction) * 0x1p-32 * 2 * std::numbers::pi;
            const double c = std::cos(angle), s = std::sin(angle);
            const double h_re = mode.cos_re[lane] * c + mode.sin_re[lane] * s;
            const double h_im = mode.cos_im[lane] * c + mode.sin_im[lane] * s;
            // i h along x and z, then P = Dx + i Dz and Q = Dx - i Dz.
            const double dx_re = -mode.dir_x[lane] * h_im, dx_im = mode.dir_x[lane] * h_re;
            const double dz_re = -mode.dir_z[lane] * h_im, dz_im = mode.dir_z[lane] * h_re;
            const double expected[] = {h_re, h_im, dx_re - dz_im, dx_im + dz_re, dx_re + dz_im, dx_im - dz_re};
            // Amplitudes are up to 4, sums of four products of them: 2e-6 of that.
            for (std::size_t c6 = 0; c6 < wave_components; ++c6)
                EXPECT_NEAR(waves[p * wave_row_floats + c6 * lane_block + lane], expected[c6], 4e-6);
        }
    }
}

// A zero must be the same zero on every instruction set (see determinism_test for
// whole frames), which a sign flipped by a unary minus would break.
TEST_P(EvolveOnEachIsa, SilenceIsPositiveZero) {
    AlignedBuffer<ModeRow> modes(1);
    AlignedBuffer<float> waves(wave_row_floats);
    kernels().evolve({.modes = modes.data(), .count = 1, .fraction = 0, .waves = waves.data()});
    for (std::size_t i = 0; i < wave_row_floats; ++i) EXPECT_FALSE(std::signbit(waves[i])) << i;
}

}  // namespace
}  // namespace pelagic
