// The half plane that the library computes really is half of a Hermitian one: where it meets its mirror, at kz = 0, the
// transformed heights are real and Q is the mirror of P. The rest is its mirror by construction.
#include <algorithm>
#include <cmath>

#include "sim/dispersion.hpp"
#include "sim/fft_plan.hpp"
#include "sim/initial_spectrum.hpp"
#include "tests/each_isa.hpp"

namespace pelagic {
namespace {

class SymmetryOnEachIsa : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(Isas, SymmetryOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

TEST_P(SymmetryOnEachIsa, ImaginaryResidueIsAMillionthOfTheRealMaximum) {
    for (int n = 16; n <= 512; n *= 2) {
        const SeaState sea{.resolution = n, .choppiness = 1};
        const WaveSpectrum model(sea);
        PackedSpectrum spectrum(n);
        for (std::size_t line = 0; line < line_count(n); ++line) bake_spectrum_line(sea, model, line, spectrum);

        AlignedBuffer<float> waves(waves_block_floats(n)), lines(lines_floats(n));
        kernels().evolve({.modes = spectrum.modes.data(),
                          .count = static_cast<std::size_t>(n),
                          .fraction = loop_fraction(12.34, sea.loop_period_s).turns,
                          .waves = waves.data()});
        const FftPlan plan(n);
        const FftTables fft = plan.tables();
        kernels().rows({.waves = waves.data(),
                        .first_line = 0,
                        .line_count = std::min(lane_block, line_count(n)),
                        .fft = &fft,
                        .lines = lines.data()});

        double real = 0, imaginary = 0, mirror = 0;
        for (std::size_t x = 0; x < static_cast<std::size_t>(n); ++x) {
            const float* at = lines.data() + x / lane_block * lines_block_floats(n) + x % lane_block;
            const auto part = [&](WaveComponent component) {
                return static_cast<double>(at[component * lane_block]);
            };
            real = std::max({real, std::fabs(part(height_re)), std::fabs(part(p_re))});
            imaginary = std::max(imaginary, std::fabs(part(height_im)));
            mirror = std::max(mirror, std::hypot(part(p_re) - part(q_re), part(p_im) + part(q_im)));
        }
        ASSERT_GT(real, 0);
        EXPECT_LE(imaginary, 1e-6 * real) << n;
        EXPECT_LE(mirror, 1e-6 * real) << n;
        RecordProperty("imaginary_" + std::to_string(n), std::to_string(imaginary / real * 1e9) + "e-9");
        RecordProperty("mirror_" + std::to_string(n), std::to_string(mirror / real * 1e9) + "e-9");
    }
}

// Nyquist: no wave there, in either direction, so no odd factor has to be cut (errata, equation 30).
TEST(Symmetry, TheNyquistColumnHoldsNoWave) {
    const SeaState sea{.resolution = 32};
    PackedSpectrum spectrum(32);
    for (std::size_t line = 0; line < line_count(32); ++line)
        bake_spectrum_line(sea, WaveSpectrum(sea), line, spectrum);
    for (const float value : spectrum.modes[16].cos_re) EXPECT_EQ(value, 0.f);
    for (const float value : spectrum.modes[16].sin_im) EXPECT_EQ(value, 0.f);
    EXPECT_NE(spectrum.modes[15].cos_re[3], 0.f);
}

}  // namespace
}  // namespace pelagic
