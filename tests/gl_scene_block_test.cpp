// What the shaders are told of a frame's tiles. Needs no driver.
#include <gtest/gtest.h>

#include <numbers>

#include "pelagic/gl/scene_block.hpp"
#include "pelagic/gl/sea_renderer.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/tile_plan.hpp"

namespace pelagic {
namespace {

// A tile is left out where pixels or vertices are as far apart as its longest waves are long; no wave may be longer.
TEST(SceneBlock, KnowsTheLongestWavesOfEachTile) {
    for (const SeaPreset& preset : sea_presets()) {
        SeaState sea = preset.sea;
        sea.resolution = 64;
        sea.cascades = is_tile_for_good(sea) ? 1 : 4;
        Ocean ocean(sea, {.executor = make_serial_executor()});
        const gl::SeaFacts facts = gl::facts_of(ocean.frame_at(0));
        const std::vector<TilePlan> plans = plan_tiles(sea);
        ASSERT_EQ(facts.tiles.size(), plans.size());
        EXPECT_EQ(facts.tiles[0].longest_wave_m, plans[0].lattice.side_m);
        for (std::size_t i = 1; i < plans.size(); ++i) {
            const double longest_m = 2 * std::numbers::pi / plans[i].least_k;
            EXPECT_GE(facts.tiles[i].longest_wave_m, longest_m * (1 - 1e-12)) << preset.name << ", tile " << i;
            EXPECT_LE(facts.tiles[i].longest_wave_m, longest_m * 1.01) << preset.name << ", tile " << i;
        }
    }
}

// Texel (0, 0) of a tile of N texels stands at the world's origin, half a texel into the texture, whatever the tile's turn; and a
// million kilometres of tiles away a viewer stands where he would within a tile.
TEST(SceneBlock, PlacesAViewerInEachTurnedTile) {
    Ocean ocean({.cascades = 4, .resolution = 64}, {.executor = make_serial_executor()});
    const gl::SeaFacts facts = gl::facts_of(ocean.frame_at(0));
    DrawList list;
    for (std::size_t i = 0; i < facts.tiles.size(); ++i) {
        const TileLattice& lattice = facts.tiles[i].lattice;
        for (const double tiles : {0.0, 1e6}) {
            const TileLattice::Place at =
                lattice.in_world((tiles + 0.25) * lattice.side_m, (3 * tiles + 0.5) * lattice.side_m);
            const gl::SceneBlock block =
                gl::scene_block_of({.eyes = {}, .viewer_m = {at.along, 5, at.across}, .list = &list}, facts, {}, {});
            // In double a metre is known to 1e-6 there, in tiles of 3 m.
            EXPECT_NEAR(block.tile_place[i].x, 0.25 + 0.5 / 64, 1e-5) << "tile " << i;
            EXPECT_NEAR(block.tile_place[i].y, 0.5 + 0.5 / 64, 1e-5) << "tile " << i;
        }
    }
}

// One pass: the sky's exposure, or the host's. Weights are for the display pass alone; stars are for the night.
TEST(SceneBlock, TakesTheHostsExposureOrTheSkys) {
    Ocean ocean({.cascades = 3, .resolution = 32}, {.executor = make_serial_executor()});
    const gl::SeaFacts facts = gl::facts_of(ocean.frame_at(0));
    DrawList list;
    gl::SkyLight sky;
    sky.exposure = 3;
    const auto block = [&](std::optional<float> exposure, bool weighs) {
        return gl::scene_block_of({.eyes = {}, .list = &list, .exposure = exposure, .weighs_samples = weighs}, facts,
                                  {}, sky);
    };
    EXPECT_EQ(block({}, false).sun_irradiance.w, 3);
    EXPECT_EQ(block(0.5f, false).sun_irradiance.w, 0.5f);
    EXPECT_EQ(block(0.5f, false).output_kind.z, 0);
    EXPECT_EQ(block(0.5f, true).output_kind.z, 0.5f);
    EXPECT_EQ(block({}, false).stars.x, 0);
    sky.true_sun_direction = {0, -1, 0};
    sky.unit = 1e-5f;
    EXPECT_GT(block({}, false).stars.x, 0);
    // A sky's unit is in what eyes see by: night vision counts candelas.
    EXPECT_FLOAT_EQ(block({}, false).output_kind.w, 1e-5f * gl::sun_illuminance_lx);
}

}  // namespace
}  // namespace pelagic
