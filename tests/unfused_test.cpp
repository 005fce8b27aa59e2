// The fused kernels are bit-identical to the separate stages.
#include <tuple>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/each_isa.hpp"
#include "pelagic/tests/emulated.hpp"
#include "pelagic/tests/sanitized.hpp"
#include "pelagic/tests/unfused/unfused_sea.hpp"

namespace pelagic {
namespace {

void expect_same_bits(SeaState sea, double time_s, Isa isa, const char* what) {
    // The roughness of the wind is not computed by a stage.
    if (sea.roughness < 0) sea.roughness = 0.1;
    Ocean ocean(sea, {.executor = make_serial_executor(), .isa = isa});
    unfused::UnfusedSea stages(sea);
    const Frame& fused = ocean.frame_at(time_s);
    const Frame& apart = stages.frame_at(time_s);
    EXPECT_EQ(hash_of(fused), hash_of(apart)) << what << ", N = " << sea.resolution;
    // Prints the position of a difference.
    for (int j = 0; j < sea.resolution; ++j) {
        for (int i = 0; i < sea.resolution; ++i) {
            ASSERT_EQ(fused.cascades[0].dx.at(i, j), apart.cascades[0].dx.at(i, j)) << i << ", " << j;
            ASSERT_EQ(fused.cascades[0].height.at(i, j), apart.cascades[0].height.at(i, j)) << i << ", " << j;
            ASSERT_EQ(fused.cascades[0].dz.at(i, j), apart.cascades[0].dz.at(i, j)) << i << ", " << j;
        }
    }
}

class UnfusedOnEachIsa : public testing::TestWithParam<std::tuple<Isa, int>> {};
INSTANTIATE_TEST_SUITE_P(
    Sizes, UnfusedOnEachIsa,
    testing::Combine(testing::ValuesIn(isas_here()), testing::Values(16, 32, 64, 128, 256, 512, 1024, 2048)),
    [](const auto& test) {
        return isa_test_name({std::get<Isa>(test.param), 0}) + "_" + std::to_string(std::get<int>(test.param));
    });

TEST_P(UnfusedOnEachIsa, StagesAreBitIdenticalToTheFusedJobs) {
    const auto [isa, n] = GetParam();
    if ((is_sanitized || is_emulated) && n > 512)
        GTEST_SKIP() << "larger sizes have no jobs of their own; release runs them";
    expect_same_bits({.resolution = n, .patch_size_m = 250, .wind_direction_rad = 1, .choppiness = 1, .lean = 0.4},
                     12.34, isa, "choppy");
    // The code of a spectrum does not depend on the size.
    if (n > (is_sanitized || is_emulated ? 64 : 128)) return;
    expect_same_bits({.resolution = n, .patch_size_m = 250}, 0, isa, "default");
    expect_same_bits({.resolution = n, .patch_size_m = 250, .choppiness = 0}, 3, isa, "without choppiness");
    for (const SpectrumModel model : values_of<SpectrumModel>())
        expect_same_bits({.spectrum = model,
                          .resolution = n,
                          .patch_size_m = 250,
                          .wind_speed_mps = 4,
                          .roughness = 0.5,
                          .swell_height_m = model == SpectrumModel::none ? 2.0 : 0},
                         7.5, isa, "every spectrum");
    expect_same_bits({.spectrum = SpectrumModel::none,
                      .resolution = n,
                      .patch_size_m = 900,
                      .depth_m = 30,
                      .systems = {{.height_m = 2, .peak_period_s = 10, .direction_rad = 2, .spread_rad = 0.3},
                                  {.spreading = SpreadingModel::donelan_banner, .peak_period_s = 6}}},
                     7.5, isa, "systems");
    expect_same_bits({.spectrum = SpectrumModel::phillips_paper,
                      .resolution = n,
                      .patch_size_m = 50,
                      .wind_speed_mps = 25,
                      .choppiness = 1},
                     77, isa, "breaking");
}

}  // namespace
}  // namespace pelagic
