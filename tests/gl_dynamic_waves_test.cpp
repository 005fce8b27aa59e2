// Dynamic waves in images: the grid's heights, slopes and foam match the queries, and outside the
// grid nothing is drawn.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/packing.hpp>
#include <numbers>
#include <stdexcept>

#include "pelagic/gl/water/dynamic_wave_textures.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/gl_probe.hpp"
#include "pelagic/tests/gl_slice.hpp"

namespace pelagic {
namespace {

/// A grid built by hand: waves that fade towards its edges, and foam, stored as an ocean stores
/// them.
class Grid {
   public:
    static constexpr int n = 64;
    struct Place {
        std::int64_t x = 0, z = 0;
        double texel_m = 0.25;
    };

    /// Both counted in texels from the grid's corner.
    Grid(const Place& first, auto&& height, auto&& foam) {
        const std::int64_t first_x = first.x, first_z = first.z;
        surface_.resolution = n;
        surface_.texel_m = first.texel_m;
        surface_.first_x = first_x;
        surface_.first_z = first_z;
        for (std::int64_t z = first_z; z < first_z + n; ++z)
            for (std::int64_t x = first_x; x < first_x + n; ++x) {
                const auto place = static_cast<std::size_t>((z & (n - 1)) * n + (x & (n - 1)));
                const bool is_edge = x == first_x || z == first_z || x == first_x + n - 1 || z == first_z + n - 1;
                heights_[place] = is_edge ? 0 : static_cast<float>(height(x - first_x, z - first_z));
                foam_[place] = is_edge ? std::uint8_t{0} : static_cast<std::uint8_t>(foam(x - first_x, z - first_z));
            }
        surface_.height_m = heights_;
        surface_.vertical_velocity_mps = rises_;
        surface_.foam = foam_;
    }
    const DynamicWavesView& surface() const { return surface_; }
    glm::dvec2 middle() const {
        return surface_.texel_m * (glm::dvec2(surface_.first_x, surface_.first_z) + 0.5 * (n - 1));
    }

   private:
    DynamicWavesView surface_;
    std::vector<float> heights_ = std::vector<float>(n * n), rises_ = heights_;
    std::vector<std::uint8_t> foam_ = std::vector<std::uint8_t>(n * n);
};

const auto no_foam = [](auto, auto) { return 0; };

Grid waves_at(std::int64_t first_x, std::int64_t first_z) {
    const auto faded = [](std::int64_t i) {
        const double s = std::sin(std::numbers::pi * static_cast<double>(i) / (Grid::n - 1));
        return s * s;
    };
    return {{.x = first_x, .z = first_z},
            [&](auto x, auto z) {
                return 0.4 * faded(x) * faded(z) *
                       std::sin(0.9 * static_cast<double>(x) - 0.6 * static_cast<double>(z));
            },
            [&](auto x, auto z) { return 255 * faded(x) * faded(z); }};
}

// Positions within and around the grid, near the world's origin and so far away that a float cannot
// resolve metres. Positions are relative to a viewer beside the grid and lie on every seam of the
// torus.
TEST(GlDynamicWaves, ShadersMatchSample) {
    constexpr double apart_m = 0.2;  // distance between positions
    GlProbe probe(gl::Surface::open, {"dynamic_waves.glsl"},
                  "result = dynamic_waves((gl_FragCoord.xy - 64.0) * 0.2 + vec2(0.013, -0.007), 0.01);");
    for (const auto& [first_x, first_z] :
         {std::pair<std::int64_t, std::int64_t>{-32, -32}, {17, -93}, {4'000'000'027, -3'999'999'991}}) {
        SCOPED_TRACE(std::to_string(first_x));
        const Grid grid = waves_at(first_x, first_z);
        gl::DynamicWaveTextures textures(probe.gl());
        ASSERT_EQ(textures.invalid_value_of(grid.surface()), "");
        textures.upload(grid.surface());
        probe.gl().Finish();

        gl::SeaFacts facts;
        facts.cascades.resize(1);
        facts.cascades[0].grid.side_m = 100;
        facts.resolution = 64;
        facts.dynamic_waves = {Grid::n, grid.surface().texel_m, first_x, first_z};
        const glm::dvec2 viewer = grid.middle() + glm::dvec2(1.7, 0.6);
        DrawList list;
        const gl::SceneBlock block = gl::scene_block_of(
            {.eyes = {}, .viewer_m = glm::dvec3(viewer.x, 2, viewer.y), .list = &list}, facts, {}, {});
        probe.gl().ActiveTexture(GL_TEXTURE0);
        probe.gl().BindTexture(GL_TEXTURE_2D, textures.texels());
        const std::vector<float> rgba = probe.ask(block);

        std::array<double, 4> worst{}, max{};
        int outside = 0;
        for (int row = 0; row < GlProbe::side; ++row)
            for (int column = 0; column < GlProbe::side; ++column) {
                // The upper row of the image has the largest y.
                const double x = viewer.x + (column + 0.5 - 64) * apart_m + 0.013;
                const double z = viewer.y + (GlProbe::side - 1 - row + 0.5 - 64) * apart_m - 0.007;
                const DynamicWavesSample wanted = sample(grid.surface(), x, z);
                const float* const read = &rgba[4 * static_cast<std::size_t>(row * GlProbe::side + column)];
                const double all[] = {wanted.height_m, wanted.slope_x, wanted.slope_z, wanted.foam};
                const glm::dvec2 from_middle = glm::abs(glm::dvec2(x, z) - grid.middle());
                if (std::max(from_middle.x, from_middle.y) > 0.5 * Grid::n * grid.surface().texel_m) {
                    ++outside;
                    for (int i = 0; i < 4; ++i) ASSERT_EQ(read[i], 0) << x << ", " << z;
                }
                for (std::size_t i = 0; i < 4; ++i) {
                    worst[i] = std::max(worst[i], std::fabs(static_cast<double>(read[i]) - all[i]));
                    max[i] = std::max(max[i], std::fabs(all[i]));
                }
            }
        std::printf("off by %.5f m of %.2f, slopes by %.5f and %.5f of %.2f and %.2f, foam by %.5f\n", worst[0],
                    max[0], worst[1], worst[2], max[1], max[2], worst[3]);
        EXPECT_GT(outside, 1000);
        EXPECT_GT(max[0], 0.3);
        // Drivers interpolate texels in steps of 1/256, and a wave may span its whole range between
        // two texels; half floats have 11 bits.
        EXPECT_LT(worst[0], 2 * 0.8 / 256);
        EXPECT_LT(worst[1], 4 * max[1] / 256);
        EXPECT_LT(worst[2], 4 * max[2] / 256);
        EXPECT_LT(worst[3], 2.0 / 256);
    }
}

// From so far away that the grid is one texel, its value is its mean: waves that a pixel averages
// out do not sparkle.
TEST(GlDynamicWaves, IsItsMeanFromFarAway) {
    GlProbe probe(gl::Surface::open, {"dynamic_waves.glsl"},
                  "result = dynamic_waves((gl_FragCoord.xy - 64.0) * 0.1, 1000.0);");
    if (!probe.gl().renders_to_half_floats) GTEST_SKIP() << "the driver makes no mips of half floats";
    const auto wave = [](auto x, auto) { return 0.3 + 0.5 * std::sin(0.7 * static_cast<double>(x)); };
    const Grid grid({.x = -19, .z = 5}, wave, [](auto, auto z) { return 4 * z; });
    gl::DynamicWaveTextures textures(probe.gl());
    textures.upload(grid.surface());
    probe.gl().Finish();
    gl::SceneBlock block;
    block.dynamic_waves_place = {0, 0, 1 / 16.f, 4};
    block.dynamic_waves_extent = {0, 0, 100, 0};
    probe.gl().ActiveTexture(GL_TEXTURE0);
    probe.gl().BindTexture(GL_TEXTURE_2D, textures.texels());
    const std::vector<float> rgba = probe.ask(block);
    double height = 0, foam = 0;
    for (const float each : grid.surface().height_m) height += static_cast<double>(each) / (Grid::n * Grid::n);
    for (const std::uint8_t each : grid.surface().foam) foam += each / 255.0 / (Grid::n * Grid::n);
    for (const std::size_t at : {std::size_t{0}, rgba.size() / 2, rgba.size() - 4}) {
        // Each of the six half-float levels is rounded.
        EXPECT_NEAR(rgba[at], height, 6 * height / 2048);
        EXPECT_NEAR(rgba[at + 1], 0, 1e-3);  // around the torus the slopes sum to zero
        EXPECT_NEAR(rgba[at + 2], 0, 1e-3);
        EXPECT_NEAR(rgba[at + 3], foam, 6 * foam / 2048);
    }
}

// IEEE 754 rounding: to the nearest, ties to even, also for subnormal numbers; values above the
// largest become the largest.
TEST(GlDynamicWaves, PacksHalvesToTheNearest) {
    struct Pair {
        float value;
        std::uint16_t half;
    };
    constexpr Pair pairs[] = {{0, 0},
                              {-0.f, 0x8000},
                              {1, 0x3c00},
                              {-1, 0xbc00},
                              {0.1f, 0x2e66},
                              {1 + 0x1p-11f, 0x3c00},
                              {1 + 3 * 0x1p-11f, 0x3c02},
                              {2047.5f, 0x6800},
                              {65504, 0x7bff},
                              {65519, 0x7bff},
                              {1e9f, 0x7bff},
                              {-1e9f, 0xfbff},
                              {0x1p-14f, 0x0400},
                              {0x1p-14f - 0x1p-25f, 0x0400},
                              {0x1p-24f, 1},
                              {0x1p-25f, 0},
                              {3 * 0x1p-25f, 2},
                              {-5 * 0x1p-24f, 0x8005},
                              {1e-12f, 0}};
    const Grid grid(
        {}, [&](auto x, auto z) { return pairs[static_cast<std::size_t>(x + z) % std::size(pairs)].value; }, no_foam);
    std::vector<std::uint32_t> words(2 * Grid::n * Grid::n);
    gl::pack(grid.surface(), words);
    for (std::size_t z = 1; z < Grid::n - 1; ++z)
        for (std::size_t x = 1; x < Grid::n - 1; ++x) {
            const Pair& wanted = pairs[(x + z) % std::size(pairs)];
            ASSERT_EQ(words[2 * (z * Grid::n + x)] & 0xffff, wanted.half) << wanted.value;
        }
}

TEST(GlDynamicWaves, IsRejectedIfNoTextureCanHoldIt) {
    const Grid grid = waves_at(0, 0);
    EXPECT_EQ(gl::check(grid.surface(), 2048), "");
    EXPECT_EQ(gl::check({}, 2048), "");
    EXPECT_EQ(gl::check(grid.surface(), 32),
              "Frame::dynamic_waves.resolution is 64, expected a power of two up to the driver's 32");
    DynamicWavesView wrong = grid.surface();
    wrong.resolution = 48;
    EXPECT_EQ(gl::check(wrong, 2048),
              "Frame::dynamic_waves.resolution is 48, expected a power of two up to the driver's 2048");
    wrong = grid.surface();
    wrong.foam = wrong.foam.first(9);
    EXPECT_EQ(gl::check(wrong, 2048), "Frame::dynamic_waves.foam.size() is 9, expected resolution^2, 4096");
    wrong = grid.surface();
    wrong.height_m = {};
    EXPECT_EQ(gl::check(wrong, 2048), "Frame::dynamic_waves.height_m.size() is 0, expected resolution^2, 4096");
    wrong = grid.surface();
    wrong.texel_m = 0;
    EXPECT_EQ(gl::check(wrong, 2048), "Frame::dynamic_waves.texel_m 0 is out of range (0, inf)");
}

// Wind waves that carry dynamic waves along, a million metres from the origin.
TEST(GlDynamicWaves, LiesAtTheQueriedPositions) {
    GlScene scene({.quality = "ultra",
                   .resolution = 128,
                   .width = slice_pixels,
                   .height = slice_pixels,
                   .samples = 1,
                   .size_m = 512,
                   .shading = gl::Shading::headset});
    const glm::dvec2 middle(1'000'017.3, -999'963.9);
    Ocean ocean(sea_named("calm", 128), {.executor = make_serial_executor(),
                                         .queries = true,
                                         .slopes = true,
                                         .dynamic_waves = DynamicWavesOptions{}});
    ocean.dynamic_waves().set_center(middle.x, middle.y);
    for (const glm::dvec2 from : {glm::dvec2(-7, 5), {4, -9}, {11, 8}})
        ocean.dynamic_waves().add_impulse({.mode = Disturbance::Mode::impulse,
                                           .x_m = middle.x + from.x,
                                           .z_m = middle.y + from.y,
                                           .radius_m = 3,
                                           .height_m = 3});
    for (int tick = 0; tick < 70; ++tick) ocean.frame_at(tick / 60.0);
    const Frame frame = ocean.complete();
    ASSERT_GT(frame.dynamic_waves.bounds.height_max_m, 0.3f);
    const auto height_in = [](const SurfaceQuery& query) {
        return [&query](double x, double z) {
            float height = 0;
            query.sample({{&x, 1}, {&z, 1}}, {.height_m = {&height, 1}});
            return static_cast<double>(height);
        };
    };
    const SurfaceQuery query(frame);
    expect_slice_in_place(scene, frame, middle, 0.1, height_in(query));
}

// The cascade displaces all water by two metres; the grid's heights stay at the grid's positions.
TEST(GlDynamicWaves, AddsAtTheDisplacedPosition) {
    GlScene scene({.quality = "ultra",
                   .resolution = 64,
                   .cascades = 1,
                   .patch_size_m = 250,
                   .width = slice_pixels,
                   .height = slice_pixels,
                   .samples = 1,
                   .size_m = 512,
                   .shading = gl::Shading::headset});
    Frame frame = scene.ocean.frame_at(3);
    Cascade cascade = frame.cascades[0];
    std::vector<std::uint16_t> carried;
    for (std::size_t i = 0; i < cascade.displacement_rgba16f.size() / 4; ++i)
        for (const float value : {2.f, 0.f, -2.f, 0.f}) carried.push_back(glm::packHalf1x16(value));
    cascade.displacement_rgba16f = carried;
    frame.cascades = {&cascade, 1};
    // Waves of 8 m: the mesh has a vertex every half metre.
    const double wave = 2 * std::numbers::pi / 8;
    const Grid grid(
        {.x = -32, .z = -32, .texel_m = 1},
        [&](auto x, auto z) {
            return 0.5 * std::sin(wave * static_cast<double>(x)) * std::sin(wave * static_cast<double>(z));
        },
        no_foam);
    frame.dynamic_waves = grid.surface();
    expect_slice_in_place(scene, frame, {0.3, 0.2}, 0.05,
                          [&](double x, double z) { return sample(grid.surface(), x, z).height_m; });
}

/// Renders a square of flat water from above, with slopes or foam in its only cascade or in its
/// grid.
class FlatScene : public GlScene {
   public:
    FlatScene()
        : GlScene({.quality = "low",
                   .resolution = 64,
                   .cascades = 1,
                   .patch_size_m = 1000,  // so large that no copies of the cascade are blended
                   .width = pixels,
                   .height = pixels,
                   .samples = 1,
                   .writes = gl::PixelKind::radiance,
                   .foam = true}),
          zeros_(ocean.frame_at(3).cascades[0].displacement_rgba16f.size()) {
        // Sunlight in the water is that of the slopes of long waves, which dynamic waves are not.
        gl::Sky sky = test_sky();
        sky.sun_irradiance = {};
        renderer->set_sky(sky);
    }

    static constexpr int pixels = 32;
    static constexpr double side_m = 1.6;  // within the grid of 3.2 m

    /// \param slope  in 1/127 of the cascade's slope range
    std::vector<float> light(glm::ivec2 slope, std::uint8_t foam, const DynamicWavesView& dynamic_waves) {
        Frame frame = ocean.frame_at(3);
        Cascade cascade = frame.cascades[0];
        // Byte 128 encodes zero.
        const std::uint32_t word =
            0x80800000u | static_cast<std::uint32_t>(128 + slope.y) << 8 | static_cast<std::uint32_t>(128 + slope.x);
        const std::vector<std::uint32_t> slopes(cascade.slopes_rgba8.size(), word),
            moments(cascade.moments_rgba8.size(), 0x00000080u);
        // The whole sea broke, at the time after which this foam is left.
        const std::vector<std::uint32_t> broken(cascade.snapshots_rgba8[0].size(), 0xFFFFFFFF);
        frame.foam.level = 2;
        frame.foam.age.fill(1 - static_cast<float>(foam) / 255);
        cascade.displacement_rgba16f = zeros_;
        cascade.slopes_rgba8 = slopes;
        cascade.moments_rgba8 = moments;
        cascade.compression_scale = 0;
        cascade.snapshots_rgba8.fill(broken);
        frame.cascades = {&cascade, 1};
        frame.dynamic_waves = dynamic_waves;
        return light_from_above(frame, pixels, side_m);
    }
    double slope_unit() { return static_cast<double>(ocean.complete().cascades[0].slope_ranges.slope) / 127; }

   private:
    std::vector<std::uint16_t> zeros_;
};

/// Returns the largest difference as a fraction of the brightest value.
double apart(const std::vector<float>& a, const std::vector<float>& b) {
    double worst = 0, max = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        worst = std::max(worst, std::fabs(static_cast<double>(a[i] - b[i])));
        max = std::max(max, static_cast<double>(a[i]));
    }
    return worst / max;
}

// The same slope in the cascade's map and in the grid gives the same light; the opposite slope does
// not.
TEST(GlDynamicWaves, TiltsNormalsAsCascadesDo) {
    FlatScene scene;
    const double unit = scene.slope_unit();
    const auto plane = [&](int x, int z) {
        return Grid(
            {.x = -32, .z = -32, .texel_m = 0.05},
            [=](auto i, auto j) {
                return unit * 0.05 * (x * (static_cast<double>(i) - 32) + z * (static_cast<double>(j) - 32));
            },
            no_foam);
    };
    const auto tilted = scene.light({100, -40}, 0, {});
    const double same = apart(tilted, scene.light({}, 0, plane(100, -40).surface()));
    const double both = apart(tilted, scene.light({70, -90}, 0, plane(30, 50).surface()));
    const double less = std::min({apart(tilted, scene.light({}, 0, plane(-100, 40).surface())),
                                  apart(tilted, scene.light({}, 0, plane(-40, 100).surface())),
                                  apart(tilted, scene.light({}, 0, plane(50, -40).surface()))});
    std::printf("slopes of %.2f and %.2f: light is %.4f apart, halves of each %.4f, others %.3f\n", 100 * unit,
                -40 * unit, same, both, less);
    EXPECT_LT(same, 0.003);
    EXPECT_LT(both, 0.003);
    EXPECT_GT(less, 0.012);
}

// Foam of the grid is as white as that of a cascade; where both have foam the larger value is used.
TEST(GlDynamicWaves, FoamIsTheMaximumOfGridAndCascades) {
    FlatScene scene;
    const auto foam = [](int byte) {
        return Grid({.x = -32, .z = -32, .texel_m = 0.05}, no_foam, [=](auto, auto) { return byte; });
    };
    const auto white = scene.light({}, 200, {});
    EXPECT_GT(apart(white, scene.light({}, 0, {})), 0.3);
    EXPECT_LT(apart(white, scene.light({}, 0, foam(200).surface())), 0.01);
    EXPECT_LT(apart(white, scene.light({}, 90, foam(200).surface())), 0.01);
    EXPECT_LT(apart(white, scene.light({}, 200, foam(90).surface())), 0.01);
    EXPECT_GT(apart(white, scene.light({}, 90, foam(90).surface())), 0.1);
}

// A grid changes pixels only inside it. A frame without a grid, or with a grid at rest, is drawn as
// without dynamic waves.
TEST(GlDynamicWaves, IsDrawnOnlyInsideItsGrid) {
    GlScene scene({.quality = "low", .resolution = 64, .width = 128, .height = 96, .samples = 1, .size_m = 512});
    const Camera camera{.position_m = {0, 30, 0}, .target_m = {0.01, 0, 0}, .vertical_view_rad = 1};
    Frame frame = scene.ocean.frame_at(3);
    const auto before = scene.image(camera, frame);
    const Grid waves = waves_at(-20, -40), flat({}, no_foam, no_foam);
    frame.dynamic_waves = waves.surface();
    const auto with = scene.image(camera, frame);
    frame.dynamic_waves = flat.surface();
    const auto resting = scene.image(camera, frame);
    frame.dynamic_waves = {};
    EXPECT_EQ(scene.image(camera, frame), before);

    int changed = 0, beyond = 0, moved = 0;
    for (int y = 0; y < 96; ++y)
        for (int x = 0; x < 128; ++x) {
            const std::size_t at = 4 * static_cast<std::size_t>(y * 128 + x);
            int max = 0;
            for (std::size_t channel = 0; channel < 3; ++channel) {
                max = std::max(max, std::abs(with[at + channel] - before[at + channel]));
                moved = std::max(moved, std::abs(resting[at + channel] - before[at + channel]));
            }
            // From 30 m the image is 33 m high; the camera's right is +z, its up is +x. Wind waves
            // bring water nearer by metres.
            const double metres = 2 * 30 * std::tan(0.5) / 96;
            const glm::dvec2 place(-(y + 0.5 - 48) * metres, (x + 0.5 - 64) * metres);
            const glm::dvec2 from = glm::abs(place - waves.middle());
            const double half = 0.5 * Grid::n * 0.25;
            changed += max > 2 && std::max(from.x, from.y) < half;
            beyond += max > 0 && std::max(from.x, from.y) > half + 3;
        }
    std::printf("%d pixels within the grid changed, %d beyond; a flat grid moved a channel by %d\n", changed, beyond,
                moved);
    EXPECT_GT(changed, 500);
    EXPECT_EQ(beyond, 0);
    EXPECT_LE(moved, 1);  // rounding may differ between compilers
}

TEST(GlDynamicWaves, IsVisibleToBothEyes) {
    GlScene scene({.quality = "low", .resolution = 64, .width = 128, .height = 48, .samples = 1, .size_m = 512});
    const Camera camera{.position_m = {0, 12, 0}, .target_m = {0.01, 0, 0}, .vertical_view_rad = 1};
    Frame frame = scene.ocean.frame_at(3);
    const auto both = [&] {
        scene.draw(camera, frame, true, true);
        return scene.target->read();
    };
    const auto before = both();
    const Grid waves = waves_at(-32, -32);
    frame.dynamic_waves = waves.surface();
    const auto with = both();
    int changed[2] = {0, 0};
    for (std::size_t pixel = 0; pixel < 128 * 48; ++pixel)
        changed[pixel % 128 / 64] += std::abs(with[4 * pixel] - before[4 * pixel]) > 2;
    std::printf("%d pixels of the left eye changed, %d of the right\n", changed[0], changed[1]);
    // The grid covers most of each eye's view, and about equally much of both.
    EXPECT_GT(changed[0], 64 * 48 / 4);
    EXPECT_NEAR(changed[1], changed[0], 0.2 * changed[0]);
}

TEST(GlDynamicWaves, IsRejectedBeforeAnyUpload) {
    GlScene scene({.quality = "low", .resolution = 64, .width = 64, .height = 48, .samples = 1});
    const Camera camera{.position_m = {0, 5, 0}, .target_m = {20, 0, 5}};
    const auto before = scene.image(camera, 3);
    const GLuint textures = scene.renderer->textures().slopes();
    Frame frame = scene.ocean.frame_at(4);
    const Grid grid = waves_at(0, 0);
    frame.dynamic_waves = grid.surface();
    frame.dynamic_waves.resolution = 48;
    EXPECT_THROW(scene.renderer->upload(frame), std::invalid_argument);
    EXPECT_EQ(scene.renderer->textures().slopes(), textures);
    EXPECT_EQ(scene.image(camera, 3), before);
}

}  // namespace
}  // namespace pelagic
