// Many frames: the driver reports no error, calls and bytes stay within their limits, and a lost
// context is handled.
#include <gtest/gtest.h>

#include "pelagic/tests/gl_scene.hpp"

namespace pelagic {
namespace {

Camera moving_camera(int frame) {
    const double x = 3.0 * frame;
    return {.position_m = {x, 5, 0.2 * x}, .target_m = {x + 100, 0, 30}};
}

std::string all_of(const std::vector<std::string>& messages) {
    std::string text;
    for (const std::string& message : messages) text += message + "\n";
    return text;
}

TEST(GlFrames, DriverReportsNothingOver200FramesWithResizesAndALostContext) {
    std::vector<std::uint8_t> before;
    for (int life = 0; life < 2; ++life) {
        // The second scene is what an application creates after a context loss: all objects are
        // new.
        GlScene scene({.quality = "low", .resolution = 64, .width = 96, .height = 64, .samples = 1, .size_m = 1024});
        ASSERT_TRUE(scene.context.has_debug());
        for (int frame = 0; frame < 100; ++frame) {
            if (frame % 25 == 24) scene.resize(64 + frame, 120 - frame);
            scene.draw(moving_camera(frame), frame / 90.0, true, frame % 2 == 1);
        }
        scene.resize(96, 64);
        const std::vector<std::uint8_t> image = scene.image(moving_camera(0), 1);
        EXPECT_EQ(all_of(scene.context.messages()), "");
        EXPECT_EQ(scene.gl().GetError(), static_cast<GLenum>(GL_NO_ERROR));
        if (life == 1) {
            EXPECT_EQ(image, before);
        }
        before = image;
    }
}

TEST(GlFrames, CallsAndBytesStayWithinTheirLimits) {
    GlScene scene({.preset = "moderate", .resolution = 128, .width = 96, .height = 64, .samples = 1, .foam = true});
    for (int frame = 0; frame < 8; ++frame) {
        const bool stereo = frame % 2 == 1;
        const gl::DrawStatistics& statistics = scene.draw(moving_camera(frame), frame / 90.0, true, stereo);
        const int views = stereo ? 2 : 1;
        EXPECT_LE(statistics.sea_calls, 17 * views);
        EXPECT_EQ(statistics.sky_calls, views);
        // An image of snapshots has three cascades. All are new to the first two frames, and at
        // most one to each frame after.
        const std::size_t texels = (4u * 128 * 128 - 1) / 3, image_bytes = 3 * 4 * texels;
        const std::size_t of_snapshots = statistics.upload_bytes - 4 * (128u * 128 * 8 + 2 * 4 * texels);
        EXPECT_EQ(of_snapshots % image_bytes, 0u);
        EXPECT_LE(of_snapshots / image_bytes, frame < 2 ? 4u : 1u);
    }
}

}  // namespace
}  // namespace pelagic
