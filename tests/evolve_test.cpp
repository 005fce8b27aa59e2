// The stage `evolve` within its job, compared with its equation in double. At N = 16, with waves
// only at kx = 0, the transform along x adds only zeros, so every column of the lines equals the
// wave.
#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>
#include <vector>

#include "pelagic/sim/cascades/packed_spectrum.hpp"
#include "pelagic/sim/kernels/fft_plan.hpp"
#include "pelagic/tests/each_isa.hpp"

namespace pelagic {
namespace {

class EvolveOnEachIsa : public OnEachIsa {
   protected:
    static constexpr int n = 16;

    EvolveOnEachIsa() : plan_(n), fft_(plan_.tables()), spectrum_(plan_, kernels().lanes) {}

    std::size_t lanes() const { return kernels().lanes; }
    std::size_t lines() const { return std::min(lanes(), line_count(n)); }

    /// The value of `quantity` for the wave kx = 0 in lane `lane`: the first wave of the first pair
    /// of groups.
    float& wave(WaveQuantity quantity, std::size_t lane) { return spectrum_.waves[quantity * lanes() + lane]; }

    AlignedBuffer<float> evolved(std::uint32_t fraction) {
        AlignedBuffer<float> out(column_blocks(n, lanes()) * column_block_floats(n, lanes()));
        kernels().evolve_rows({.waves = spectrum_.block(0),
                               .harmonics = spectrum_.block_harmonics(0),
                               .fraction = fraction,
                               .first_line = 0,
                               .line_count = lines(),
                               .fft = &fft_,
                               .lines = out.data()});
        return out;
    }

    FftPlan plan_;
    FftTables fft_;
    PackedSpectrum spectrum_;
};
INSTANTIATE_TEST_SUITE_P(Isas, EvolveOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

// With S'_xy = (1, 0) and S'_zw = (0, 1) the wave is cos + i sin of its phase. Rounding the phase
// to float changes it by up to pi/4 2^-24, and the polynomials' last two roundings add 2^-24: in
// sum less than a step of 2^-23.
TEST_P(EvolveOnEachIsa, RotationIsWithinOneFloatStepAtEveryPhase) {
    constexpr double step = 0x1p-23;
    std::mt19937 random(7);
    std::vector<std::uint32_t> phases;
    // Phases near each sixteenth of a turn, which include the ends of the polynomials' range, and
    // random phases.
    for (std::uint32_t sixteenth = 0; sixteenth < 16; ++sixteenth)
        for (std::uint32_t i = 0; i < 64; ++i) phases.push_back((sixteenth << 28) + i - 32);
    while (phases.size() < 65536) phases.push_back(static_cast<std::uint32_t>(random()));

    for (std::size_t lane = 0; lane < lines(); ++lane) {
        wave(plus_cos_re, lane) = 1;
        wave(plus_sin_im, lane) = 1;
    }
    for (std::size_t first = 0; first < phases.size(); first += lines()) {
        for (std::size_t lane = 0; lane < lines(); ++lane) spectrum_.harmonics[lane] = phases[first + lane];
        const AlignedBuffer<float> out = evolved(1);
        for (std::size_t lane = 0; lane < lines(); ++lane) {
            const double angle = phases[first + lane] * 0x1p-32 * 2 * std::numbers::pi;
            const float* line = out.data() + lane * line_components * lanes();
            ASSERT_NEAR(line[height_re * lanes()], std::cos(angle), step) << phases[first + lane];
            ASSERT_NEAR(line[height_im * lanes()], std::sin(angle), step) << phases[first + lane];
        }
    }
}

TEST_P(EvolveOnEachIsa, MatchesItsEquationInDouble) {
    std::mt19937 random(11);
    std::normal_distribution<float> amplitude;
    for (int round = 0; round < 200; ++round) {
        const auto fraction = static_cast<std::uint32_t>(random());
        for (std::size_t lane = 0; lane < lines(); ++lane) {
            for (const WaveQuantity part : {plus_cos_re, plus_cos_im, plus_sin_re, plus_sin_im})
                wave(part, lane) = amplitude(random);
            const float angle = amplitude(random);
            wave(direction_x, lane) = std::cos(angle);
            wave(direction_z, lane) = std::sin(angle);
            wave(lean_tangent, lane) = amplitude(random) / 4;
            spectrum_.harmonics[lane] = static_cast<std::uint32_t>(random() % 2000);
        }
        const AlignedBuffer<float> out = evolved(fraction);
        for (std::size_t lane = 0; lane < lines(); ++lane) {
            const double angle =
                static_cast<std::uint32_t>(spectrum_.harmonics[lane] * fraction) * 0x1p-32 * 2 * std::numbers::pi;
            const double c = std::cos(angle), s = std::sin(angle);
            const double h_re = wave(plus_cos_re, lane) * c + wave(plus_sin_re, lane) * s;
            const double h_im = wave(plus_cos_im, lane) * c + wave(plus_sin_im, lane) * s;
            // Plus the quadrature in time times the lean, which gives d.
            const double lean = wave(lean_tangent, lane);
            const double d_re = h_re + lean * (wave(plus_sin_re, lane) * c - wave(plus_cos_re, lane) * s);
            const double d_im = h_im + lean * (wave(plus_sin_im, lane) * c - wave(plus_cos_im, lane) * s);
            // i d times the direction's x and z components, then
            // P = -(Dx + i Dz) and R = -i (Dx - i Dz).
            const double dx_re = -wave(direction_x, lane) * d_im, dx_im = wave(direction_x, lane) * d_re;
            const double dz_re = -wave(direction_z, lane) * d_im, dz_im = wave(direction_z, lane) * d_re;
            double expected[line_components];
            expected[height_re] = h_re;
            expected[height_im] = h_im;
            expected[p_re] = -(dx_re - dz_im);
            expected[p_im] = -(dx_im + dz_re);
            expected[r_re] = dx_im - dz_re;
            expected[r_im] = -(dx_re + dz_im);
            // Amplitudes are up to 4 and each value sums eight products of them: a relative error of
            // 2e-6.
            for (std::size_t c6 = 0; c6 < line_components; ++c6)
                ASSERT_NEAR(out[(lane * line_components + c6) * lanes()], expected[c6], 4e-6) << c6;
        }
    }
}

// Zeros must have the same sign on every instruction set (see determinism_test.cpp for whole
// frames). A sign change by unary minus would give negative zeros.
TEST_P(EvolveOnEachIsa, ZeroAmplitudesGivePositiveZeros) {
    const AlignedBuffer<float> out = evolved(0);
    for (std::size_t i = 0; i < out.size(); ++i) EXPECT_FALSE(std::signbit(out[i])) << i;
}

}  // namespace
}  // namespace pelagic
