// The GPU's textures hold the values that the sea computed, and each frame is drawn with its own
// sea.
#include <dlfcn.h>
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <glm/gtc/packing.hpp>
#include <stdexcept>
#include <string>

#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/tests/gl_scene.hpp"
#include "pelagic/tests/message_of.hpp"

namespace pelagic {
namespace {

/// Functions that only this test calls.
template <class Function>
Function gl_function(const char* name) {
    const auto get =
        reinterpret_cast<void* (*)(const char*)>(dlsym(dlopen("libEGL.so.1", RTLD_NOW), "eglGetProcAddress"));
    return reinterpret_cast<Function>(get(name));
}

/// Reads a level of a layer of a texture through a framebuffer.
template <class Value>
std::vector<Value> read_level(const gl::Functions& gl, GLuint texture, int layer, int level, int side, GLenum type) {
    const auto attach_layer = gl_function<PFNGLFRAMEBUFFERTEXTURELAYERPROC>("glFramebufferTextureLayer");
    gl::Framebuffer framebuffer(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    attach_layer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, texture, level, layer);
    EXPECT_EQ(gl.CheckFramebufferStatus(GL_FRAMEBUFFER), static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
    std::vector<Value> values(std::size_t{4} * side * side);
    gl.ReadPixels(0, 0, side, side, GL_RGBA, type, values.data());
    return values;
}

class GlUploads : public testing::TestWithParam<int> {};

// Seven uploads pass more than once around the ring of pixel buffers and the pair of textures.
TEST_P(GlUploads, TexturesHoldTheFramesBytesInEveryMip) {
    GlScene scene({.resolution = 64, .cascades = GetParam(), .width = 64, .height = 64, .foam = true});
    Ocean mapped(scene.ocean.sea(), {.executor = make_serial_executor(), .slopes = true, .foam = true});
    for (int i = 0; i < 7; ++i) {
        const Frame& frame = scene.ocean.frame_at(0.37 * i);
        if (i % 3 == 2) {  // its texels were written directly into the mapped memory of the driver
            mapped.schedule(frame.time_s, scene.renderer->map_textures());
            scene.renderer->upload(mapped.complete());
        } else {
            // and the application wrote nothing there
            if (i % 3 == 1) scene.renderer->map_textures();
            scene.renderer->upload(frame);
        }
        const gl::FrameTextures& textures = scene.renderer->textures();
        ASSERT_EQ(frame.cascades.size(), static_cast<std::size_t>(GetParam()));
        ASSERT_TRUE(textures.has_foam());
        for (int layer = 0; layer < GetParam(); ++layer) {
            const Cascade& cascade = frame.cascades[static_cast<std::size_t>(layer)];
            const auto is_in = [&](GLuint texture, std::span<const std::uint32_t> chain, int level) {
                const auto bytes =
                    read_level<std::uint8_t>(scene.gl(), texture, layer, level, 64 >> level, GL_UNSIGNED_BYTE);
                return 0 == std::memcmp(bytes.data(), cascade.level_of(chain, level).data(), bytes.size());
            };
            const auto is_snapshot = [&](std::size_t image, int level) {
                if (cascade.snapshots_rgba8[image].empty()) return true;
                const int at = static_cast<int>(image * textures.foam_cascades()) + layer;
                const auto bytes = read_level<std::uint8_t>(scene.gl(), textures.snapshots(), at, level, 64 >> level,
                                                            GL_UNSIGNED_BYTE);
                const auto wanted = cascade.level_of(cascade.snapshots_rgba8[image], level);
                return 0 == std::memcmp(bytes.data(), wanted.data(), bytes.size());
            };
            for (int level = 0; level < mip_levels(64); ++level) {
                ASSERT_TRUE(is_in(textures.slopes(), cascade.slopes_rgba8, level))
                    << "frame " << i << ", cascade " << layer << ", level " << level;
                ASSERT_TRUE(is_in(textures.moments(), cascade.moments_rgba8, level))
                    << "frame " << i << ", cascade " << layer << ", level " << level;
                for (std::size_t image = 0; image < SnapshotFoam::images; ++image)
                    ASSERT_TRUE(is_snapshot(image, level))
                        << "frame " << i << ", cascade " << layer << ", level " << level << ", image " << image;
            }
            // Every half is exactly a float, so the conversion through floats is lossless.
            const auto floats = read_level<float>(scene.gl(), textures.displacement(), layer, 0, 64, GL_FLOAT);
            for (std::size_t v = 0; v < floats.size(); ++v)
                ASSERT_EQ(glm::packHalf1x16(floats[v]), cascade.displacement_rgba16f[v])
                    << "frame " << i << ", cascade " << layer << ", value " << v;
        }
    }
}
INSTANTIATE_TEST_SUITE_P(Cascades, GlUploads, testing::Values(1, 4),
                         [](const auto& cascades) { return std::to_string(cascades.param); });

TEST(GlUpload, RejectsAnUnsuitableFrameAndNamesWhatIsMissing) {
    gl::HeadlessContext context;
    gl::SeaRenderer renderer(context.functions(), {.resolution = 32, .cascades = 1});
    const auto refused = [&](const SeaState& sea, const OceanOptions& options) {
        Ocean ocean(sea, options);
        return message_of([&] { renderer.upload(ocean.frame_at(0)); });
    };
    const auto serial = make_serial_executor();
    EXPECT_EQ(refused({.resolution = 32, .patch_size_m = 60}, {.executor = serial, .slopes = true}), "");
    EXPECT_EQ(refused({.resolution = 32, .patch_size_m = 60}, {.executor = serial}),
              "the frame has no slopes; drawing needs an ocean with OceanOptions::slopes");
    EXPECT_EQ(refused({.resolution = 64, .patch_size_m = 60}, {.executor = serial, .slopes = true}),
              "the frame has cascades of 64 texels, the renderer was made for 32 (RendererOptions::resolution)");
    EXPECT_EQ(refused({.cascades = 3, .resolution = 32}, {.executor = serial}),
              "the frame has 3 cascades, the renderer was made for 1 (RendererOptions::cascades)");
    EXPECT_THROW(gl::SeaRenderer(context.functions(), {.cascades = 5}), std::invalid_argument);

    Ocean ocean({.resolution = 32, .patch_size_m = 60}, {.executor = serial, .slopes = true});
    AlignedBuffer<std::uint16_t> halves(4 * 32 * 32);
    const TextureTargets elsewhere{.displacement_rgba16f = halves.data()};
    for (const bool is_mapped : {false, true}) {
        if (is_mapped) renderer.map_textures();  // memory that the frame does not use
        ocean.schedule(0, {&elsewhere, 1});
        EXPECT_EQ(message_of([&] { renderer.upload(ocean.complete()); }),
                  "the frame's textures are in memory that FrameTextures::map() did not return");
    }
}

TEST(GlUpload, ChangeOfSeaDrawsEachFrameWithItsOwnSea) {
    // The sequence of an application that changes the sea: the new sea exists while the old one's
    // last frame is still to be drawn.
    const Camera camera{.position_m = {0, 10, 0}, .target_m = {60, 0, 40}};
    const SeaState storm = sea_named("storm", 128);
    GlScene scene({.preset = "calm", .quality = "low", .resolution = 128, .width = 96, .height = 64, .samples = 1});
    const Frame& last_calm = scene.ocean.frame_at(3);
    const auto calm_image = scene.image(camera, last_calm);
    scene.ocean.schedule_sea(storm);
    scene.ocean.complete_sea();
    scene.ocean.schedule(3);
    const auto last_calm_image = scene.image(camera, last_calm);
    const auto changed_image = scene.image(camera, scene.ocean.complete());
    GlScene fresh({.preset = "storm", .quality = "low", .resolution = 128, .width = 96, .height = 64, .samples = 1});
    const auto storm_image = fresh.image(camera, 3);

    EXPECT_EQ(last_calm_image, calm_image);
    EXPECT_EQ(changed_image, storm_image);
    EXPECT_NE(changed_image, calm_image);
}

}  // namespace
}  // namespace pelagic
