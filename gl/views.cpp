#include "pelagic/gl/views.hpp"

namespace pelagic::gl {

Eye eye_of(const Camera& camera, const Viewport& viewport) {
    const double aspect = static_cast<double>(viewport.width) / viewport.height;
    return {camera.clip_from_world(aspect), camera.position_m, viewport};
}

std::vector<Eye> eyes_of(const Camera& camera, const Viewport& both, double apart_m) {
    const Viewport left{both.x, both.y, both.width / 2, both.height};
    const Viewport right{both.x + both.width / 2, both.y, both.width - both.width / 2, both.height};
    return {eye_of(camera.moved_right(-apart_m / 2), left), eye_of(camera.moved_right(apart_m / 2), right)};
}

}  // namespace pelagic::gl
