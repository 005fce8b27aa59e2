// Stages `rows` and `columns` alone, each size, against a DFT in double: X[x] = sum over p of w[p] e^{+2 pi i p x / N}.
#include <cmath>
#include <complex>
#include <numbers>
#include <random>
#include <tuple>
#include <vector>

#include "sim/fft_plan.hpp"
#include "sim/wave_blocks.hpp"
#include "simd/aligned_buffer.hpp"
#include "tests/each_isa.hpp"

namespace pelagic {
namespace {

using Line = std::vector<std::complex<double>>;

// Only some outputs, so that 2048 stays quick: every one of a small size, 64 spread ones of a large size.
std::vector<std::size_t> outputs_to_check(std::size_t size) {
    std::vector<std::size_t> outputs;
    const std::size_t step = size <= 64 ? 1 : size / 64 - 1;
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

// A float transform of N points loses about eps sqrt(log2 N) of the rms; against the maximum that is far below the
// 2e-6 that the project promises for whole fields.
constexpr double tolerance = 2e-6;

class TransformOnEachIsa : public testing::TestWithParam<std::tuple<Isa, int>> {
   protected:
    TransformOnEachIsa() : plan_(resolution()), fft_(plan_.tables()), random_(42) {}
    int resolution() const { return std::get<int>(GetParam()); }
    std::size_t size() const { return static_cast<std::size_t>(resolution()); }
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
    AlignedBuffer<float> waves(waves_block_floats(resolution()));
    AlignedBuffer<float> lines(lines_floats(resolution()));
    const std::size_t lanes = std::min(lane_block, line_count(resolution()));
    for (std::size_t i = 0; i < waves.size(); ++i)
        if (i % lane_block < lanes) waves[i] = noise();

    // The last block of lines: its place in the output is the interesting one.
    const std::size_t first_line = (line_blocks(resolution()) - 1) * lane_block;
    kernels().rows(
        {.waves = waves.data(), .first_line = first_line, .line_count = lanes, .fft = &fft_, .lines = lines.data()});

    for (std::size_t lane = 0; lane < lanes; lane += 5) {
        for (std::size_t part = 0; part < wave_components; part += 2) {
            Line line(size());
            for (std::size_t p = 0; p < size(); ++p) {
                const float* wave = waves.data() + p * wave_row_floats + part * lane_block + lane;
                line[p] = {wave[0], wave[lane_block]};
            }
            const double largest = 4 * std::sqrt(static_cast<double>(size()));  // four sigma of the sum
            for (const std::size_t x : outputs_to_check(size())) {
                const std::complex<double> expected = naive_inverse_dft(line, x);
                const float* out = lines.data() + x / lane_block * lines_block_floats(resolution()) +
                                   (first_line + lane) * wave_row_floats + part * lane_block + x % lane_block;
                ASSERT_NEAR(out[0], expected.real(), tolerance * largest) << x;
                ASSERT_NEAR(out[lane_block], expected.imag(), tolerance * largest) << x;
            }
        }
    }
}

TEST_P(TransformOnEachIsa, ColumnsTurnHalfAPlaneIntoRealFields) {
    const std::size_t blocks = std::min<std::size_t>(2, column_blocks(resolution()));
    AlignedBuffer<float> lines(blocks * lines_block_floats(resolution()));
    AlignedBuffer<float> surface(blocks * surface_block_floats(resolution()));
    for (std::size_t i = 0; i < lines.size(); ++i) lines[i] = noise();
    // The sea's own symmetry: at kz = 0 a column of heights is real, and Q is the mirror of P.
    for (std::size_t block = 0; block < blocks; ++block) {
        float* row = lines.data() + block * lines_block_floats(resolution());
        for (std::size_t lane = 0; lane < lane_block; ++lane) row[height_im * lane_block + lane] = 0;
    }

    ColumnsJob job{.lines = {}, .fft = &fft_, .surface = {}};
    for (std::size_t block = 0; block < blocks; ++block) {
        job.lines[block] = lines.data() + block * lines_block_floats(resolution());
        job.surface[block] = surface.data() + block * surface_block_floats(resolution());
    }
    kernels().columns(job);

    for (std::size_t column = 0; column < blocks * lane_block; column += 3) {
        const std::size_t block = column / lane_block, lane = column % lane_block;
        const auto value = [&](std::size_t n, std::size_t part) {
            const float* at = job.lines[block] + n * wave_row_floats + part * lane_block + lane;
            return std::complex<double>(at[0], at[lane_block]);
        };
        Line height(size()), sideways(size());
        height[0] = value(0, height_re);
        sideways[0] = value(0, p_re);
        for (std::size_t n = 1; n < size() / 2; ++n) {
            height[n] = value(n, height_re);
            height[size() - n] = std::conj(height[n]);
            sideways[n] = value(n, p_re);
            sideways[size() - n] = std::conj(value(n, q_re));
        }
        const double largest = 4 * std::sqrt(2.0 * static_cast<double>(size()));
        for (const std::size_t z : outputs_to_check(size())) {
            const float* out = job.surface[block] + z * surface_row_floats + lane;
            const std::complex<double> h = naive_inverse_dft(height, z), d = naive_inverse_dft(sideways, z);
            ASSERT_NEAR(out[surface_height * lane_block], h.real(), tolerance * largest) << z;
            ASSERT_NEAR(out[surface_dx * lane_block], d.real(), tolerance * largest) << z;
            ASSERT_NEAR(out[surface_dz * lane_block], d.imag(), tolerance * largest) << z;
        }
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
