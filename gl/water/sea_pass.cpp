#include "pelagic/gl/water/sea_pass.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <functional>

#include "pelagic/gl/stopwatch.hpp"

namespace pelagic::gl {
namespace {

/// Returns the plane at the viewer. Small water is nearly level, so its plane is level.
std::optional<CameraWaterPlane> water_plane(const Frame& frame, Surface surface, const glm::dvec3& viewer_m) {
    if (surface != Surface::open) return CameraWaterPlane{.height_m = frame.water_frame.sea_level_m};
    if (frame.cascades[0].folds.empty() && frame.cascades[0].contraction.empty()) return {};  // no queries
    return camera_water_plane(SurfaceQuery(frame), viewer_m);
}

}  // namespace

SeaPass::SeaPass(const Functions& gl, const RendererOptions& options, const QuadtreeOptions& quadtree,
                 CausticsBaking caustics)
    : renderer_(gl, options), selection_(quadtree), surface_(options.surface), caustics_(caustics) {
    if (caustics != CausticsBaking::none)
        baker_.emplace(options.executor ? options.executor : make_serial_executor());
}

void SeaPass::complete_caustics() {
    if (is_baking_) renderer_.set_caustics(baker_->complete());
    is_baking_ = false;
}

void SeaPass::upload(const Frame& frame) {
    has_baked_ = is_baking_;
    complete_caustics();
    renderer_.upload(frame);
    frame_ = frame;
}

DrawStatistics SeaPass::draw(DrawInput input) {
    assert(!input.eyes.empty() && input.eyes.size() <= 2);
    const glm::dvec3 viewer = input.viewer();
    const Stopwatch select;
    std::array<glm::dmat4, 2> views;
    std::transform(input.eyes.begin(), input.eyes.end(), views.begin(), std::mem_fn(&Eye::clip_from_world));
    input.list = &selection_.select({.viewer_m = viewer,
                                     .views = {views.data(), input.eyes.size()},
                                     .bounds = frame_.bounds,
                                     .sea_level_m = frame_.water_frame.sea_level_m});
    const double select_ms = select.milliseconds();
    input.camera_water_plane = water_plane(frame_, surface_, viewer);
    const bool bakes = baker_ && input.camera_water_plane && !is_baking_ && !has_baked_;
    if (const auto wanted =
            bakes ? renderer_.visible_caustics(viewer.y - input.camera_water_plane->height_m) : std::nullopt) {
        baker_->schedule(frame_, *wanted);
        is_baking_ = true;
        if (caustics_ == CausticsBaking::before_drawn) complete_caustics();
    }
    DrawStatistics drawn = renderer_.draw(input);
    drawn.select_ms = select_ms;
    return drawn;
}

}  // namespace pelagic::gl
