// What arrives in the GPU's textures is what the sea computed, and each frame is drawn as the sea that it is.
#include <gtest/gtest.h>

#include <array>
#include <cstring>
#include <glm/gtc/packing.hpp>

#include "pelagic/tests/gl_scene.hpp"

namespace pelagic {
namespace {

/// A level of a texture, read through a framebuffer.
template <class Value>
std::vector<Value> read_level(const gl::Functions& gl, GLuint texture, int level, int side, GLenum type) {
    gl::Framebuffer framebuffer(gl);
    gl.BindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    gl.FramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, texture, level);
    EXPECT_EQ(gl.CheckFramebufferStatus(GL_FRAMEBUFFER), static_cast<GLenum>(GL_FRAMEBUFFER_COMPLETE));
    std::vector<Value> values(std::size_t{4} * side * side);
    gl.ReadPixels(0, 0, side, side, GL_RGBA, type, values.data());
    return values;
}

// Seven uploads go around the ring of pixel buffers and the pair of textures more than once.
TEST(GlUpload, TexturesHoldTheFramesBytesInEveryMip) {
    GlScene scene({.resolution = 128, .patch_size_m = 250, .width = 64, .height = 64});
    for (int i = 0; i < 7; ++i) {
        const Frame& frame = scene.ocean.frame_at(0.37 * i);
        scene.renderer->upload(frame);
        const gl::FrameTextures& textures = scene.renderer->textures();
        for (int level = 0; level < mip_levels(128); ++level) {
            const auto bytes =
                read_level<std::uint8_t>(scene.gl(), textures.gradient(), level, 128 >> level, GL_UNSIGNED_BYTE);
            ASSERT_EQ(0, std::memcmp(bytes.data(), frame.tiles[0].gradient_level(level).data(), bytes.size()))
                << "frame " << i << ", level " << level;
        }
        // Every half is a float too, so the way through floats loses nothing.
        const auto floats = read_level<float>(scene.gl(), textures.displacement(), 0, 128, GL_FLOAT);
        for (std::size_t v = 0; v < floats.size(); ++v)
            ASSERT_EQ(glm::packHalf1x16(floats[v]), frame.tiles[0].displacement_rgba16f[v])
                << "frame " << i << ", value " << v;
    }
}

TEST(GlUpload, AChangeOfSeaDrawsEachFrameAsTheSeaThatItIs) {
    // As a host changes the sea: the new one is there while the old one's last frame is still to be drawn.
    const Camera camera{.position_m = {0, 10, 0}, .target_m = {60, 0, 40}};
    const SeaState storm = sea_named("storm", 128);
    GlScene scene({.preset = "calm",
                   .quality = "low",
                   .resolution = 128,
                   .patch_size_m = 250,
                   .width = 96,
                   .height = 64,
                   .samples = 1});
    const Frame& last_calm = scene.ocean.frame_at(3);
    const auto calm_picture = scene.picture(camera, last_calm);
    scene.ocean.schedule_sea(storm);
    scene.ocean.complete_sea();
    scene.ocean.schedule(3);
    const auto last_calm_picture = scene.picture(camera, last_calm);
    const auto changed_picture = scene.picture(camera, scene.ocean.complete());
    GlScene fresh({.preset = "storm",
                   .quality = "low",
                   .resolution = 128,
                   .patch_size_m = 250,
                   .width = 96,
                   .height = 64,
                   .samples = 1});
    const auto storm_picture = fresh.picture(camera, 3);

    EXPECT_EQ(last_calm_picture, calm_picture);
    EXPECT_EQ(changed_picture, storm_picture);
    EXPECT_NE(changed_picture, calm_picture);
}

}  // namespace
}  // namespace pelagic
