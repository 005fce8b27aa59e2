// The slope kernels are bit-identical to the same arithmetic on one float at a time.
#include <random>
#include <tuple>

#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/kernel_slopes.hpp"

namespace pelagic {
namespace {

/// Noise instead of waves, so that exchanged values differ.
unfused::CascadePlanes noise(int resolution, float cosine, float sine) {
    std::mt19937 random(7);
    const auto plane = [&] {
        std::vector<float> values(static_cast<std::size_t>(resolution) * static_cast<std::size_t>(resolution));
        for (float& value : values) value = static_cast<float>(random() % 20001) / 10000 - 1;
        return values;
    };
    return {resolution, 2.5 * resolution, cosine, sine, plane(), plane(), plane()};
}

class UnfusedSlopesOnEachIsa : public testing::TestWithParam<std::tuple<Isa, int>> {};
INSTANTIATE_TEST_SUITE_P(
    Sizes, UnfusedSlopesOnEachIsa,
    testing::Combine(testing::ValuesIn(isas_here()), testing::Values(16, 32, 64, 128, 256, 512)),
    [](const auto& test) {
        return isa_test_name({std::get<Isa>(test.param), 0}) + "_" + std::to_string(std::get<int>(test.param));
    });

TEST_P(UnfusedSlopesOnEachIsa, AreBitIdenticalToTheFusedJobs) {
    const auto [isa, n] = GetParam();
    for (const bool is_rotated : {false, true}) {
        const unfused::CascadePlanes planes = is_rotated ? noise(n, 0.8f, -0.6f) : noise(n, 1, 0);
        // Some values are beyond these ranges.
        const SlopeRanges ranges{0.5f, 0.1f};
        const unfused::CascadeSlopes fused = slopes_by(kernels_for(isa), planes, ranges);
        const unfused::CascadeSlopes apart = unfused::slopes_of(planes, ranges);
        EXPECT_EQ(fused.slopes, apart.slopes) << "turned " << is_rotated;
        EXPECT_EQ(fused.moments, apart.moments) << "turned " << is_rotated;
        EXPECT_EQ(fused.halves, apart.halves) << "turned " << is_rotated;
    }
}

}  // namespace
}  // namespace pelagic
