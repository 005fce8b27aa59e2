// Stage `finalize` alone: exact, because it only multiplies by lambda and moves.
#include <random>

#include "sim/wave_blocks.hpp"
#include "simd/aligned_buffer.hpp"
#include "tests/each_isa.hpp"

namespace pelagic {
namespace {

class FinalizeOnEachIsa : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(Isas, FinalizeOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

TEST_P(FinalizeOnEachIsa, PlanesAreTheSurfaceTimesLambdaWithWrappedNeighbours) {
    constexpr int n = 32;
    constexpr std::ptrdiff_t stride = n + lane_block;
    constexpr float lambda = 0.7f;
    AlignedBuffer<float> surface(column_blocks(n) * surface_block_floats(n));
    std::mt19937 random(5);
    for (std::size_t i = 0; i < surface.size(); ++i) surface[i] = std::normal_distribution<float>()(random);

    AlignedBuffer<float> storage(3 * (lane_block + stride * n));
    FinalizeJob job{.surface = surface.data(),
                    .resolution = n,
                    .first_row = 0,
                    .end_row = n,
                    .choppiness = lambda,
                    .planes = {},
                    .stride = stride,
                    .bounds = nullptr};
    for (std::size_t c = 0; c < 3; ++c) job.planes[c] = storage.data() + c * (lane_block + stride * n) + lane_block;
    RowBounds bounds;
    job.bounds = &bounds;
    kernels().finalize(job);

    for (std::size_t c = 0; c < surface_components; ++c) {
        for (std::size_t z = 0; z < n; ++z) {
            const float* row = job.planes[c] + static_cast<std::ptrdiff_t>(z) * stride;
            for (std::size_t x = 0; x < n; ++x) {
                const float raw = surface[x / lane_block * surface_block_floats(n) + z * surface_row_floats +
                                          c * lane_block + x % lane_block];
                EXPECT_EQ(row[x], c == surface_height ? raw : raw * lambda);
            }
            EXPECT_EQ(row[-1], row[n - 1]);
            EXPECT_EQ(row[n], row[0]);
        }
    }
}

// Whatever the order in which lanes meet them, zeros of both signs count as one zero.
TEST_P(FinalizeOnEachIsa, BoundsOfAStillSeaArePositiveZeros) {
    constexpr int n = 16;
    AlignedBuffer<float> surface(surface_block_floats(n)), storage(3 * (lane_block + (n + lane_block) * n));
    for (std::size_t i = 0; i < surface.size(); i += 3) surface[i] = -0.f;
    RowBounds bounds;
    FinalizeJob job{.surface = surface.data(),
                    .resolution = n,
                    .first_row = 0,
                    .end_row = n,
                    .choppiness = 1,
                    .planes = {},
                    .stride = n + lane_block,
                    .bounds = &bounds};
    for (std::size_t c = 0; c < 3; ++c)
        job.planes[c] = storage.data() + c * (lane_block + (n + lane_block) * n) + lane_block;
    kernels().finalize(job);
    for (const float bound : {bounds.height_min, bounds.height_max, bounds.sideways_x_max, bounds.sideways_z_max}) {
        EXPECT_EQ(bound, 0.f);
        EXPECT_FALSE(std::signbit(bound));
    }
}

}  // namespace
}  // namespace pelagic
