// The slope kernels are bit-identical to the same arithmetic on one float at a time.
#include <cmath>
#include <cstdint>
#include <random>
#include <tuple>
#include <vector>

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

/// A difference of height over two texels of 0.5 m on level water, and the byte of its normal.
struct NormalByte {
    float difference_m;
    std::uint32_t byte;
};

/// Normals (-difference, 1, 0) with another byte if a product and its sum are rounded once, as by a
/// fused multiply-add, and not twice.
std::vector<NormalByte> bytes_that_fusing_changes() {
    std::vector<NormalByte> bytes;
    for (int step = -125; step <= 125; ++step) {
        // floats about the one at which the byte changes to this step from the middle
        const double part = step / 127.5;
        auto difference = static_cast<float>(-part / std::sqrt(1 - part * part));
        for (int i = 0; i < 40; ++i) difference = std::nextafter(difference, -1000.f);
        for (int i = 0; i < 80; ++i, difference = std::nextafter(difference, 1000.f)) {
            const float to_byte = 1 / std::sqrt(difference * difference + 1.f) * 127.5f;
            const auto twice = static_cast<std::uint32_t>(-difference * to_byte + 128.f),
                       once = static_cast<std::uint32_t>(std::fma(-difference, to_byte, 128.f));
            if (twice != once) bytes.push_back({difference, twice});
        }
    }
    return bytes;
}

class GradientBytesOnEachIsa : public OnEachIsa {};
INSTANTIATE_TEST_SUITE_P(, GradientBytesOnEachIsa, testing::ValuesIn(isas_here()), isa_test_name);

TEST_P(GradientBytesOnEachIsa, AreOfProductsAndSumsThatAreRoundedApart) {
    constexpr std::size_t n = 256;
    const std::vector<NormalByte> all = bytes_that_fusing_changes();
    ASSERT_GE(all.size(), n / 4);
    const auto used = [&](std::size_t i) { return all[i / 4 * all.size() / (n / 4)]; };
    for (const bool along_x : {true, false}) {
        const std::vector<float> flat(n * n);
        unfused::CascadePlanes planes{n, 0.5 * n, 1, 0, flat, flat, flat};
        // every fourth line is raised, so that the line before it slopes by its height alone
        for (std::size_t i = 0; i < n; i += 4)
            for (std::size_t j = 0; j < n; ++j)
                planes.height[along_x ? j * n + i + 1 : (i + 1) * n + j] = used(i).difference_m;
        const Gradients gradients = gradients_by(kernels(), planes, false);
        for (std::size_t i = 0; i < n; i += 4)
            for (std::size_t j = 0; j < n; ++j) {
                const std::uint32_t texel = gradients.texels[along_x ? j * n + i : i * n + j];
                ASSERT_EQ(texel >> (along_x ? 0 : 8) & 0xFF, used(i).byte) << used(i).difference_m;
            }
    }
}

}  // namespace
}  // namespace pelagic
