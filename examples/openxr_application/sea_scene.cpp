#include "sea_scene.hpp"

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <glm/gtc/quaternion.hpp>

namespace openxr_application {
namespace {

using namespace pelagic;

/// Texels along a face of the sky.
constexpr int sky_face_size = 128;
/// Distance of the near plane.
constexpr double near_m = 0.1;

/// Returns the projection of an eye to OpenGL's clip space. The far plane is at infinity, because
/// the sea ends at the horizon, where the quadtree's skirt is at infinity (w = 0).
glm::dmat4 projection(const XrFovf& fov) {
    const double left = std::tan(double{fov.angleLeft}), right = std::tan(double{fov.angleRight});
    const double down = std::tan(double{fov.angleDown}), up = std::tan(double{fov.angleUp});
    glm::dmat4 clip(0);
    clip[0][0] = 2 / (right - left);
    clip[1][1] = 2 / (up - down);
    clip[2] = {(right + left) / (right - left), (up + down) / (up - down), -1, -1};
    clip[3][2] = -2 * near_m;
    return clip;
}

/// \param origin_m  origin of the headset's space in the world; x and z are horizontal and y is up
///                  in both
gl::Eye eye_of(const XrView& view, const glm::dvec3& origin_m, const EyeImages& images) {
    const XrVector3f& p = view.pose.position;
    const XrQuaternionf& q = view.pose.orientation;
    const glm::dvec3 position = origin_m + glm::dvec3(p.x, p.y, p.z);
    const glm::dmat4 turn = glm::mat4_cast(glm::normalize(glm::dquat(q.w, q.x, q.y, q.z)));
    return {.clip_from_world = projection(view.fov) * glm::transpose(turn) * glm::translate(glm::dmat4(1), -position),
            .position_m = position,
            .viewport = {0, 0, images.width(), images.height()}};
}

/// Returns the origin of the headset's space, above the height that crests usually reach.
glm::dvec3 origin_above(const Frame& frame) { return {0, 3 + frame.statistics.significant_wave_height_m, 0}; }

}  // namespace

SeaScene::SeaScene(const SeaState& sea, const QuadtreePreset& quality, const gl::Functions& gl, bool multiview)
    : ocean_(sea, {.slopes = true, .foam = true}),
      pass_(gl,
            {.resolution = ocean_.resolution(),
             .cascades = ocean_.cascade_count(),
             .shading = gl::Shading::headset,
             .framebuffer_is_srgb = true,
             .multiview = multiview},
            quality.options(2048)) {
    gl::SkyBaker baker(make_default_executor(), sky_face_size);
    baker.schedule({.sun_azimuth_rad = -0.6f, .sun_elevation_rad = 0.8f});
    pass_.renderer().set_sky(baker.complete());
}

void SeaScene::schedule(double time_s, bool hashed) {
    if (hashed)
        ocean_.schedule(time_s);
    else
        ocean_.schedule(time_s, pass_.renderer().map_textures());  // directly into a pixel buffer
}

void SeaScene::complete() {
    frame_ = &ocean_.complete();
    pass_.upload(*frame_);
}

void SeaScene::draw(const std::array<XrView, 2>& views, const EyeImages& images) {
    const glm::dvec3 origin = origin_above(*frame_);
    const std::array<gl::Eye, 2> eyes = {eye_of(views[0], origin, images), eye_of(views[1], origin, images)};
    if (images.is_multiview()) {
        images.bind_both();
        pass_.draw({.eyes = eyes});
        return;
    }
    const glm::dvec3 viewer = (eyes[0].position_m + eyes[1].position_m) / 2.0;
    for (std::size_t eye = 0; eye < 2; ++eye) {
        images.bind_eye(eye);
        pass_.draw({.eyes = {&eyes[eye], 1}, .viewer_m = viewer});  // both eyes see the same mesh
    }
}

}  // namespace openxr_application
