// The computed half plane is half of a Hermitian field: at its edge, kz = 0, the transformed
// heights are real and Q mirrors P. The rest is symmetric by construction.
#include <algorithm>
#include <cmath>

#include "pelagic/sim/cascades/packed_spectrum.hpp"
#include "pelagic/sim/kernels/fft_plan.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/tests/each_isa.hpp"

namespace pelagic {
namespace {

class SymmetryOnEachIsa : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(Isas, SymmetryOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

TEST_P(SymmetryOnEachIsa, ImaginaryResidueIsAMillionthOfTheRealMaximum) {
    for (int n = 16; n <= 512; n *= 2) {
        const SeaState sea{.resolution = n, .patch_size_m = 250, .choppiness = 1};
        const CascadeWaves waves(sea, plan_cascades(sea).front());
        const FftPlan plan(n);
        const FftTables fft = plan.tables();
        const std::size_t lanes = kernels().lanes;
        PackedSpectrum spectrum(plan, lanes);
        for (std::size_t line = 0; line < line_count(n); ++line) bake_spectrum_line(sea, waves, plan, line, spectrum);

        AlignedBuffer<float> lines(column_blocks(n, lanes) * column_block_floats(n, lanes));
        kernels().evolve_rows({.waves = spectrum.block(0),
                               .harmonics = spectrum.block_harmonics(0),
                               .fraction = loop_fraction(12.34, sea.loop_period_s).turns,
                               .first_line = 0,
                               .line_count = std::min(lanes, line_count(n)),
                               .fft = &fft,
                               .lines = lines.data()});

        double real = 0, imaginary = 0, mirror = 0;
        for (std::size_t x = 0; x < static_cast<std::size_t>(n); ++x) {
            const float* at = lines.data() + x / lanes * column_block_floats(n, lanes) + x % lanes;
            const auto part = [&](LineComponent component) { return static_cast<double>(at[component * lanes]); };
            real = std::max({real, std::fabs(part(height_re)), std::fabs(part(p_re))});
            imaginary = std::max(imaginary, std::fabs(part(height_im)));
            // conj(R / i) is R with real and imaginary part exchanged.
            mirror = std::max(mirror, std::hypot(part(p_re) - part(r_im), part(p_im) - part(r_re)));
        }
        ASSERT_GT(real, 0);
        EXPECT_LE(imaginary, 1e-6 * real) << n;
        EXPECT_LE(mirror, 1e-6 * real) << n;
        RecordProperty("imaginary_" + std::to_string(n), std::to_string(imaginary / real * 1e9) + "e-9");
        RecordProperty("mirror_" + std::to_string(n), std::to_string(mirror / real * 1e9) + "e-9");
    }
}

// Nyquist: no wave in either direction, so no odd factor needs to be removed (errata, equation 30).
TEST(Symmetry, TheNyquistColumnHasNoWave) {
    const SeaState sea{.resolution = 32, .patch_size_m = 250};
    const CascadeWaves waves(sea, plan_cascades(sea).front());
    for (int k = -15; k < 16; ++k) {
        EXPECT_EQ(waves.amplitude(-16, k), 0.0);
        EXPECT_EQ(waves.amplitude(k, -16), 0.0);
    }
    EXPECT_NE(waves.amplitude(15, 3), 0.0);

    // Group 0 has the inputs 0, N/R, ...: N/2 is its middle element.
    const FftPlan plan(32);
    PackedSpectrum spectrum(plan, 4);
    for (std::size_t line = 0; line < line_count(32); ++line) bake_spectrum_line(sea, waves, plan, line, spectrum);
    ASSERT_EQ(plan.pairs().front().plus, 0);
    const auto wave = static_cast<std::size_t>(plan.tables().first_step().radix) / 2;
    for (std::size_t i = 0; i < wave_quantities * 4; ++i)
        EXPECT_EQ(spectrum.waves[wave * wave_quantities * 4 + i], 0);
    EXPECT_NE(spectrum.waves[(wave + 1) * wave_quantities * 4 + 3], 0);
}

}  // namespace
}  // namespace pelagic
