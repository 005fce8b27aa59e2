// The parameters that the shaders get for a frame's cascades. These tests need no driver.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pelagic/gl/water/foam_image.hpp"
#include "pelagic/gl/water/scene_block.hpp"
#include "pelagic/gl/water/sea_renderer.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/shores.hpp"

namespace pelagic {
namespace {

// Shaders omit a cascade where the spacing of pixels or vertices is as large as its longest
// wavelength. No wave may be longer.
TEST(SceneBlock, StoresTheLongestWavelengthOfEachCascade) {
    for (const SeaPreset& preset : sea_presets()) {
        SeaState sea = preset.sea;
        if (sea.waves == WaveModel::pond) continue;
        sea.resolution = 64;
        sea.cascades = is_limited_to_one_cascade(sea) ? 1 : 4;
        Ocean ocean(sea, {.executor = make_serial_executor()});
        const gl::SeaFacts facts = gl::facts_of(ocean.frame_at(0));
        const std::vector<CascadePlan> plans = plan_cascades(sea);
        ASSERT_EQ(facts.cascades.size(), plans.size());
        EXPECT_EQ(facts.cascades[0].longest_wave_m, plans[0].grid.side_m);
        for (std::size_t i = 1; i < plans.size(); ++i) {
            const double longest_m = 2 * std::numbers::pi / plans[i].min_k;
            EXPECT_GE(facts.cascades[i].longest_wave_m, longest_m * (1 - 1e-12)) << preset.name << ", cascade " << i;
            EXPECT_LE(facts.cascades[i].longest_wave_m, longest_m * 1.01) << preset.name << ", cascade " << i;
        }
    }
}

// Texel (0, 0) of a cascade of N texels is at the world's origin, half a texel into the texture,
// whatever the cascade's rotation. A viewer a million kilometres away has the same position in the
// texture as one in the first period.
TEST(SceneBlock, PlacesAViewerInEachRotatedCascade) {
    Ocean ocean({.cascades = 4, .resolution = 64}, {.executor = make_serial_executor()});
    const gl::SeaFacts facts = gl::facts_of(ocean.frame_at(0));
    DrawList list;
    for (std::size_t i = 0; i < facts.cascades.size(); ++i) {
        const CascadeGrid& grid = facts.cascades[i].grid;
        for (const double cascades : {0.0, 1e6}) {
            const CascadeGrid::Vector at =
                grid.in_world((cascades + 0.25) * grid.side_m, (3 * cascades + 0.5) * grid.side_m);
            const gl::SceneBlock block = gl::scene_block_of(
                {.eyes = {}, .viewer_m = glm::dvec3(at.along, 5, at.across), .list = &list}, facts, {}, {});
            // There a double resolves 1e-6 m; the cascades are 3 m wide.
            EXPECT_NEAR(block.cascade_place[i].x, 0.25 + 0.5 / 64, 1e-5) << "cascade " << i;
            EXPECT_NEAR(block.cascade_place[i].y, 0.5 + 0.5 / 64, 1e-5) << "cascade " << i;
        }
    }
}

// A shore and a floor keep their places in the water when the world's origin is shifted.
TEST(SceneBlock, PlacesShoreAndFloorByTheOrigin) {
    OceanOptions options{.executor = make_serial_executor()};
    options.shore = bay();
    Ocean ocean({.cascades = 3, .resolution = 32, .wind_speed_mps = 8}, options);
    const gl::SeaFloor floor = gl::floor_of(bay());
    DrawList list;
    const auto block_at = [&](glm::dvec3 viewer_m) {
        const gl::SeaFacts facts = gl::facts_of(ocean.frame_at(3));
        const gl::DrawInput input{.eyes = {}, .viewer_m = viewer_m, .list = &list};
        gl::SceneBlock block = gl::scene_block_of(input, facts, {}, {});
        gl::place_below(block, input, facts, floor, {});
        return block;
    };
    const gl::SceneBlock before = block_at({20, 3, -30});
    ocean.set_origin(1e7, -123'456);
    const gl::SceneBlock after = block_at({20 - 1e7, 3, -30 + 123'456});
    EXPECT_NE(before.shore_place.x, 0);
    EXPECT_NE(before.floor_place.x, 0);
    EXPECT_EQ(after.shore_place, before.shore_place);
    EXPECT_EQ(after.floor_place, before.floor_place);
    EXPECT_EQ(after.floor_size, before.floor_size);
    EXPECT_EQ(after.floor_mesh, before.floor_mesh);
}

// The foam structure drifts with the foam maps. It moves by whole squares in a loop, as fast as
// this allows, and is back at its start after one loop.
TEST(SceneBlock, MovesTheFoamStructureWithTheFoam) {
    Ocean ocean({.cascades = 3, .resolution = 32, .wind_speed_mps = 14, .wind_direction_rad = 0.6},
                {.executor = make_serial_executor(), .foam = true});
    DrawList list;
    const auto shift_at = [&](double time_s) {
        gl::SeaFacts facts = gl::facts_of(ocean.frame_at(time_s));
        facts.has_foam = true;
        return gl::scene_block_of({.eyes = {}, .list = &list}, facts, {}, {}).foam_shift;
    };
    const SeaStatistics statistics = ocean.frame_at(0).statistics;
    const double loop_s = ocean.sea().loop_period_s;
    constexpr double step_s = 0.2;  // less than half of a square of bubbles, 0.14 m
    const glm::vec4 first = shift_at(0), then = shift_at(step_s), after_a_loop = shift_at(loop_s);
    const double sides_m[] = {gl::FoamSizes::bubbles_m, gl::FoamSizes::bubbles_m, gl::FoamSizes::lace_m,
                              gl::FoamSizes::lace_m};
    for (int i = 0; i < 4; ++i) {
        const double drift_mps = i % 2 == 0 ? statistics.foam_drift_x_mps : statistics.foam_drift_z_mps;
        const double turned = static_cast<double>(first[i]) - static_cast<double>(then[i]);
        const double moved_mps = (turned - std::round(turned)) * sides_m[i] / step_s;
        EXPECT_GT(drift_mps, 0.1);
        EXPECT_NEAR(moved_mps, drift_mps, 0.5 * sides_m[i] / loop_s + 1e-5) << i;
        EXPECT_EQ(first[i], after_a_loop[i]) << i;
    }
}

// The finest cascade makes no foam, and a frame without foam has a level that no wave reaches.
TEST(SceneBlock, DescribesTheSnapshotsOfAFrame) {
    Ocean ocean({.cascades = 4, .resolution = 32, .wind_speed_mps = 14},
                {.executor = make_serial_executor(), .foam = true});
    DrawList list;
    const Frame& frame = ocean.frame_at(11.1);
    gl::SeaFacts facts = gl::facts_of(frame);
    for (const bool has_foam : {true, false}) {
        facts.has_foam = has_foam;
        const gl::SceneBlock block = gl::scene_block_of({.eyes = {}, .list = &list}, facts, {}, {});
        EXPECT_EQ(block.foam_kind.x, has_foam ? frame.foam.level : 1000);
        EXPECT_EQ(block.foam_front.x, frame.cascades[0].compression_front_x);
        EXPECT_EQ(block.foam_front.y, frame.cascades[0].compression_front_z);
        for (std::size_t i = 0; i < block.foam_cascade.size(); ++i) {
            const Cascade& cascade = frame.cascades[i];
            EXPECT_EQ(block.foam_cascade[i].w, 1);
            EXPECT_EQ(block.foam_cascade[i].z, cascade.compression_scale);
            EXPECT_NEAR(block.foam_cascade[i].x, cascade.drift_columns / 32, 1e-6);
            EXPECT_NEAR(block.foam_cascade[i].y, cascade.drift_rows / 32, 1e-6);
        }
        EXPECT_TRUE(frame.cascades[3].snapshots_rgba8[0].empty());
        for (std::size_t slot = 0; slot < 16; ++slot)
            EXPECT_EQ(block.foam_age[slot / 4][static_cast<int>(slot % 4)], frame.foam.age[slot]);
    }
}

// With one pass, the exposure is the sky's or the application's. Weights are for the display pass
// alone; stars are for the night.
TEST(SceneBlock, UsesTheApplicationsExposureOrTheSkys) {
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
    sky.options.sun_elevation_rad = -1.5f;
    sky.unit = 1e-5f;
    EXPECT_GT(block({}, false).stars.x, 0);
    // A sky's unit is in photometric units: night vision uses cd/m^2.
    EXPECT_FLOAT_EQ(block({}, false).output_kind.w, 1e-5f * gl::sun_illuminance_lx);
}

}  // namespace
}  // namespace pelagic
