// The jobs evolve+rows and columns+finalize alone, at each size, compared with a DFT in double:
// X[x] = sum over p of w[p] e^{+2 pi i p x / N}.
#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <tuple>
#include <vector>

#include "pelagic/sim/cascades/packed_spectrum.hpp"
#include "pelagic/sim/kernels/fft_plan.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/sanitized.hpp"

namespace pelagic {
namespace {

using Line = std::vector<std::complex<double>>;

// Returns the outputs to check: all of a small size, 64 of a large size, so that 2048 is fast.
std::vector<std::size_t> outputs_to_check(std::size_t size) {
    std::vector<std::size_t> outputs;
    const std::size_t max = is_sanitized ? 16 : 64, step = size <= max ? 1 : size / max - 1;
    for (std::size_t x = 0; x < size; x += step) outputs.push_back(x);
    outputs.push_back(size - 1);
    return outputs;
}

std::complex<double> naive_inverse_dft(const Line& line, std::size_t x) {
    std::complex<double> sum = 0;
    for (std::size_t p = 0; p < line.size(); ++p)
        sum += line[p] * std::polar(1.0, 2 * std::numbers::pi * static_cast<double>(p * x % line.size()) /
                                             static_cast<double>(line.size()));
    return sum;
}

// A float transform of N points has an error of about eps sqrt(log2 N) of the rms. Relative to the
// maximum this is far below the documented 2e-6 for whole fields.
constexpr double tolerance = 2e-6;

class TransformOnEachIsa : public testing::TestWithParam<std::tuple<Isa, int>> {
   protected:
    TransformOnEachIsa() : plan_(resolution()), fft_(plan_.tables()), random_(42) {}
    int resolution() const { return std::get<int>(GetParam()); }
    std::size_t size() const { return static_cast<std::size_t>(resolution()); }
    std::size_t lanes() const { return kernels().lanes; }
    const Kernels& kernels() const { return kernels_for(std::get<Isa>(GetParam())); }
    float noise() { return std::normal_distribution<float>()(random_); }

    FftPlan plan_;
    FftTables fft_;
    std::mt19937 random_;
};

INSTANTIATE_TEST_SUITE_P(
    Sizes, TransformOnEachIsa,
    testing::Combine(testing::ValuesIn(isas_here()), testing::Values(16, 32, 64, 128, 256, 512, 1024, 2048)),
    [](const auto& test) {
        return isa_test_name({std::get<Isa>(test.param), 0}) + "_" + std::to_string(std::get<int>(test.param));
    });

TEST_P(TransformOnEachIsa, RowsAreInverseTransformsWithXAsTheLane) {
    PackedSpectrum spectrum(plan_, lanes());
    // The last block of lines is the most difficult case for the position in the output.
    const std::size_t block = line_blocks(resolution(), lanes()) - 1;
    const std::size_t first_line = block * lanes();
    const std::size_t lines_here = std::min(lanes(), line_count(resolution()));
    constexpr std::uint32_t fraction = 0x12345678;

    // Random waves, and the three fields that they give at this moment, in double; kx = -p is at N
    // - p.
    const int radix = fft_.first_step().radix;
    std::vector<std::array<Line, 3>> expected(lines_here, {Line(size()), Line(size()), Line(size())});
    float* wave = spectrum.block(block);
    std::uint32_t* harmonic = spectrum.block_harmonics(block);
    for (const GroupPair& pair : plan_.pairs()) {
        for (int s = 0; s < radix; ++s, wave += wave_quantities * lanes(), harmonic += lanes()) {
            const std::size_t position = pair.plus + static_cast<std::size_t>(s) * (size() / radix);
            for (std::size_t lane = 0; lane < lines_here; ++lane) {
                const auto quantity = [&](std::size_t number) -> float& { return wave[number * lanes() + lane]; };
                harmonic[lane] = static_cast<std::uint32_t>(random_());
                const double angle = harmonic[lane] * fraction * 0x1p-32 * 2 * std::numbers::pi;
                const float direction = noise();
                quantity(direction_x) = std::cos(direction);
                quantity(direction_z) = std::sin(direction);
                quantity(lean_tangent) = noise() / 4;
                for (const bool is_minus : {false, true}) {
                    if (is_minus && pair.is_own_negative()) continue;
                    const std::size_t first = is_minus ? minus_cos_re : plus_cos_re;
                    for (std::size_t i = 0; i < 4; ++i) quantity(first + i) = noise();
                    const double c = std::cos(angle), sine = std::sin(angle);
                    const std::complex<double> h(quantity(first) * c + quantity(first + 2) * sine,
                                                 quantity(first + 1) * c + quantity(first + 3) * sine);
                    const std::complex<double> i_unit(0, 1);
                    const std::complex<double> quadrature(quantity(first + 2) * c - quantity(first) * sine,
                                                          quantity(first + 3) * c - quantity(first + 1) * sine);
                    const std::complex<double> leaning = h + 1.0 * quantity(lean_tangent) * quadrature;
                    const double x = is_minus ? -quantity(direction_x) : quantity(direction_x);
                    const std::complex<double> dx = i_unit * x * leaning,
                                               dz = i_unit * (1.0 * quantity(direction_z)) * leaning;
                    const std::size_t p = is_minus ? (size() - position) % size() : position;
                    expected[lane][0][p] = h;
                    expected[lane][1][p] = -(dx + i_unit * dz);
                    expected[lane][2][p] = -i_unit * (dx - i_unit * dz);
                }
            }
        }
    }

    AlignedBuffer<float> lines(column_blocks(resolution(), lanes()) * column_block_floats(resolution(), lanes()));
    kernels().evolve_rows({.waves = spectrum.block(block),
                           .harmonics = spectrum.block_harmonics(block),
                           .fraction = fraction,
                           .first_line = first_line,
                           .line_count = lines_here,
                           .fft = &fft_,
                           .lines = lines.data()});

    const double largest = 4 * std::sqrt(static_cast<double>(size()));  // four sigma of the sum
    constexpr LineComponent parts[3][2] = {{height_re, height_im}, {p_re, p_im}, {r_re, r_im}};
    for (std::size_t lane = 0; lane < lines_here; lane += 5) {
        for (std::size_t field = 0; field < 3; ++field) {
            for (const std::size_t x : outputs_to_check(size())) {
                const std::complex<double> truth = naive_inverse_dft(expected[lane][field], x);
                const float* out = lines.data() + x / lanes() * column_block_floats(resolution(), lanes()) +
                                   (first_line + lane) * line_components * lanes() + x % lanes();
                ASSERT_NEAR(out[parts[field][0] * lanes()], truth.real(), tolerance * largest) << x;
                ASSERT_NEAR(out[parts[field][1] * lanes()], truth.imag(), tolerance * largest) << x;
            }
        }
    }
}

TEST_P(TransformOnEachIsa, ColumnsTurnHalfAPlaneIntoRealFieldsTimesChoppiness) {
    constexpr float choppiness = 0.7f;
    const std::size_t block_floats = column_block_floats(resolution(), lanes());
    const std::size_t row_floats = line_components * lanes();
    const ColumnBlockPair pair =
        column_block_pair(resolution(), lanes(), column_block_pairs(resolution(), lanes()) - 1);
    AlignedBuffer<float> data(column_blocks(resolution(), lanes()) * block_floats);
    for (std::size_t i = 0; i < data.size(); ++i) data[i] = noise();
    // The sea's symmetry: at kz = 0 a column of heights is real.
    std::vector<std::size_t> blocks = {pair.first};
    if (pair.has_second) blocks.push_back(pair.second);
    for (const std::size_t block : blocks)
        for (std::size_t lane = 0; lane < lanes(); ++lane)
            data[block * block_floats + height_im * lanes() + lane] = 0;
    const std::vector<float> lines(data.data(), data.data() + data.size());

    FrameBounds bounds;
    ColumnsFinalizeJob job{
        .blocks = {}, .fft = &fft_, .choppiness = choppiness, .cosine = 1, .sine = 0, .bounds = &bounds};
    for (std::size_t i = 0; i < blocks.size(); ++i) job.blocks[i] = data.data() + blocks[i] * block_floats;
    kernels().columns_finalize(job);

    FrameBounds expected{data[blocks[0] * block_floats + surface_height * lanes()], -1e30f, 0, 0};
    for (const std::size_t block : blocks) {
        for (std::size_t lane = 0; lane < lanes(); ++lane) {
            for (std::size_t z = 0; z < size(); ++z) {
                const float* out = data.data() + block * block_floats + z * surface_components * lanes() + lane;
                expected.height_min_m = std::min(expected.height_min_m, out[surface_height * lanes()]);
                expected.height_max_m = std::max(expected.height_max_m, out[surface_height * lanes()]);
                expected.horizontal_x_max_m =
                    std::max(expected.horizontal_x_max_m, std::fabs(out[surface_dx * lanes()]));
                expected.horizontal_z_max_m =
                    std::max(expected.horizontal_z_max_m, std::fabs(out[surface_dz * lanes()]));
            }
            if (lane % 3 != 0) continue;
            const auto value = [&](std::size_t n, LineComponent re, LineComponent im) {
                const float* at = lines.data() + block * block_floats + n * row_floats + lane;
                return std::complex<double>(at[re * lanes()], at[im * lanes()]);
            };
            // P = -(Dx + i Dz) belongs to kz. The conjugate of -(Dx - i Dz), which is R over i,
            // belongs to -kz.
            Line height(size()), horizontal(size());
            height[0] = value(0, height_re, height_im);
            horizontal[0] = value(0, p_re, p_im);
            for (std::size_t n = 1; n < size() / 2; ++n) {
                height[n] = value(n, height_re, height_im);
                height[size() - n] = std::conj(height[n]);
                horizontal[n] = value(n, p_re, p_im);
                horizontal[size() - n] = std::conj(std::complex<double>(0, -1) * value(n, r_re, r_im));
            }
            const double largest = 4 * std::sqrt(2.0 * static_cast<double>(size()));
            for (const std::size_t z : outputs_to_check(size())) {
                const float* out = data.data() + block * block_floats + z * surface_components * lanes() + lane;
                const std::complex<double> h = naive_inverse_dft(height, z), d = -naive_inverse_dft(horizontal, z);
                ASSERT_NEAR(out[surface_height * lanes()], h.real(), tolerance * largest) << z;
                ASSERT_NEAR(out[surface_dx * lanes()], choppiness * d.real(), tolerance * largest) << z;
                ASSERT_NEAR(out[surface_dz * lanes()], choppiness * d.imag(), tolerance * largest) << z;
            }
        }
    }
    EXPECT_EQ(bounds.height_min_m, expected.height_min_m);
    EXPECT_EQ(bounds.height_max_m, expected.height_max_m);
    EXPECT_EQ(bounds.horizontal_x_max_m, expected.horizontal_x_max_m);
    EXPECT_EQ(bounds.horizontal_z_max_m, expected.horizontal_z_max_m);
}

// Zeros of both signs count as one zero, in whatever order lanes read them.
TEST_P(TransformOnEachIsa, BoundsOfAStillSeaArePositiveZeros) {
    AlignedBuffer<float> data(2 * column_block_floats(resolution(), lanes()));
    for (std::size_t i = 0; i < data.size(); i += 3) data[i] = -0.f;
    FrameBounds bounds;
    kernels().columns_finalize({.blocks = {data.data(), data.data() + column_block_floats(resolution(), lanes())},
                                .fft = &fft_,
                                .choppiness = 1,
                                .cosine = 1,
                                .sine = 0,
                                .bounds = &bounds});
    for (const float bound :
         {bounds.height_min_m, bounds.height_max_m, bounds.horizontal_x_max_m, bounds.horizontal_z_max_m}) {
        EXPECT_EQ(bound, 0.f);
        EXPECT_FALSE(std::signbit(bound));
    }
}

// Every input is in the first step once, with its negative in the partner group at the opposite
// position. Parts are in the order in which the last step completes them.
TEST(FftPlan, PairsHaveEveryInputOnceWithItsNegative) {
    for (int size = 16; size <= 2048; size *= 2) {
        const FftPlan plan(size);
        const FftTables fft = plan.tables();
        const int radix = fft.first_step().radix, parts = fft.last_step().radix;
        std::vector<int> hits(static_cast<std::size_t>(size));
        const auto input = [&](int group, int s) { return group + s * (size / radix); };
        for (int part = 0; part <= parts / 2; ++part) {
            for (int number = fft.first_pair[part]; number < fft.first_pair[part + 1]; ++number) {
                const GroupPair pair = fft.pairs[number];
                EXPECT_EQ(pair.plus % parts, part);
                EXPECT_EQ(pair.minus % parts, (parts - part) % parts);
                for (int s = 0; s < radix; ++s) {
                    ++hits.at(static_cast<std::size_t>(input(pair.plus, s)));
                    EXPECT_EQ(fft.positions[input(pair.plus, s)], fft.positions[pair.plus] + s);
                    if (pair.is_own_negative()) continue;
                    ++hits.at(static_cast<std::size_t>(input(pair.minus, s)));
                    EXPECT_EQ(input(pair.minus, radix - 1 - s), size - input(pair.plus, s));
                }
            }
        }
        EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), size);
        EXPECT_EQ(fft.first_pair[parts / 2 + 1], plan.pairs().size());
    }
}

TEST(FftPlan, PositionsArePermutations) {
    for (int size = 16; size <= 2048; size *= 2) {
        const FftPlan plan(size);
        std::vector<int> hits(static_cast<std::size_t>(size));
        for (int i = 0; i < size; ++i) ++hits.at(plan.tables().positions[i]);
        EXPECT_EQ(std::count(hits.begin(), hits.end(), 1), size);
    }
}

}  // namespace
}  // namespace pelagic
