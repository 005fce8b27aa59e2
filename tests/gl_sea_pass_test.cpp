// gl::SeaPass draws the image that its steps draw one by one.
#include <gtest/gtest.h>

#include <vector>

#include "pelagic/tests/gl_scene.hpp"

namespace pelagic {
namespace {

/// A shallow sea from just above or below the water, with caustics on its floor and a droplet.
class GlSeaPass : public testing::Test {
   protected:
    GlSeaPass() {
        steps_.set_sky(test_sky());
        scene_.spray = {.droplets = {&droplet_, 1}};
    }
    void bake(gl::CausticsBaking caustics) {
        scene_.pass.emplace(scene_.gl(), options_, scene_.selection.options(), caustics);
        scene_.pass->renderer().set_sky(test_sky());
    }
    /// Draws the frame step by step, with the caustics of a frame, or with the last ones.
    std::vector<std::uint8_t> image_by_steps(const Camera& camera, const Frame& frame, const Frame* caustics_of) {
        gl::CausticsBaker baker(make_serial_executor());
        if (caustics_of) {
            baker.schedule(*caustics_of, {.depth_m = depth_m, .sun = gl::sun_direction(test_sky().options)});
            steps_.set_caustics(baker.complete());
        }
        const gl::Eye eye = gl::eye_of(camera, {0, 0, width, height});
        const glm::dvec3 viewer = camera.position_m;
        scene_.target->clear();
        steps_.upload(frame);
        steps_.draw({.eyes = {&eye, 1},
                     .list = &scene_.selection.select(
                         {.viewer_m = viewer, .views = {&eye.clip_from_world, 1}, .bounds = frame.bounds}),
                     .camera_water_plane = gl::camera_water_plane(SurfaceQuery(frame), viewer),
                     .spray = scene_.spray});
        return scene_.target->read();
    }

    static constexpr int width = 96, height = 54;
    static constexpr double depth_m = 3;
    GlScene scene_{{.preset = "calm",
                    .quality = "low",
                    .resolution = 32,
                    .cascades = 1,
                    .patch_size_m = 32,
                    .width = width,
                    .height = height,
                    .size_m = 512,
                    .shading = gl::Shading::medium,
                    .depth_m = depth_m,
                    .lens_may_dip = true}};
    const gl::RendererOptions options_{.resolution = 32, .cascades = 1, .shading = gl::Shading::medium};
    gl::SeaRenderer steps_{scene_.gl(), options_};
    const SprayDroplet droplet_{.x_m = 3, .y_m = 0.8, .z_m = 2, .radius_m = 0.5, .opacity = 0.5f};
    const Camera above_{.position_m = {0, 1.5, 0}, .target_m = {6, -1, 4}};
    const Camera below_{.position_m = {0, -1, 0}, .target_m = {6, -1.5, 4}};
};

TEST_F(GlSeaPass, BeforeAFrameIsDrawnItsCausticsAreBaked) {
    bake(gl::CausticsBaking::before_drawn);
    for (const Camera& camera : {above_, below_}) {
        const Frame& frame = scene_.ocean.frame_at(3);
        EXPECT_EQ(scene_.image(camera, frame), image_by_steps(camera, frame, &frame));
    }
}

TEST_F(GlSeaPass, WhileAFrameIsDrawnTheCausticsOfTheNextAreBaked) {
    bake(gl::CausticsBaking::while_drawn);
    const Frame first = scene_.ocean.frame_at(3);
    EXPECT_EQ(scene_.image(below_, first), image_by_steps(below_, first, nullptr));
    const Frame& second = scene_.ocean.frame_at(3.1);  // in the other slot: the first stays valid
    const auto own = image_by_steps(below_, second, &second), earlier = image_by_steps(below_, second, &first);
    EXPECT_NE(own, earlier) << "caustics are not visible";
    EXPECT_EQ(scene_.image(below_, second), earlier);
    const Frame& third = scene_.ocean.frame_at(3.2);  // nothing is baked while the second is drawn
    EXPECT_EQ(scene_.image(below_, third), image_by_steps(below_, third, nullptr));
}

TEST_F(GlSeaPass, EyesOfOneViewerSeeOneMeshInSeparateDraws) {
    scene_.draw(above_, scene_.ocean.frame_at(3), true, true);
    const auto together = scene_.target->read();
    scene_.target->clear();
    for (const gl::Eye& eye : gl::eyes_of(above_, {0, 0, width, height}, GlScene::eye_distance_m))
        scene_.pass->draw({.eyes = {&eye, 1}, .viewer_m = above_.position_m, .spray = scene_.spray});
    EXPECT_EQ(scene_.target->read(), together);
}

}  // namespace
}  // namespace pelagic
