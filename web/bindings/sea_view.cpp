#include "pelagic/web/bindings/sea_view.hpp"

#include <cmath>
#include <utility>

#include "pelagic/gl/gl_state_guard.hpp"
#include "pelagic/gl/stopwatch.hpp"
#include "pelagic/message/require.hpp"

namespace pelagic::web {
namespace {

/// Texels along a side of the coarse sky without clouds, drawn until the first sky is baked.
constexpr int plain_face_size = 16;

}  // namespace

SeaView::SeaView(const gl::Functions& gl, const SeaState& sea, const ViewOptions& options)
    : gl_(gl),
      options_(options),
      quadtree_(quadtree_preset_named(options.quality)->options(options.size_m)),
      plain_(executor_, plain_face_size),
      baker_(slices_, options.sky_face_size) {
    set_sea(sea);
}

void SeaView::set_sea(const SeaState& sea) {
    make_ocean(sea);
    if (options_.hull) options_.hull->release();
}

void SeaView::make_ocean(const SeaState& sea) {
    const bool floats = options_.hull.has_value();
    auto next = std::make_unique<Ocean>(
        sea, OceanOptions{.executor = executor_,
                          .queries = true,
                          .velocities = floats ? Velocities::water : Velocities::none,
                          .depth = floats,
                          .slopes = true,
                          .foam = options_.foam});
    const bool fits =
        pass_ && next->resolution() == ocean_->resolution() && next->cascade_count() == ocean_->cascade_count();
    ocean_ = std::move(next);
    frame_ = nullptr;
    if (fits) return;
    pass_.emplace(
        gl_,
        gl::RendererOptions{
            .resolution = ocean_->resolution(), .cascades = ocean_->cascade_count(), .shading = options_.shading},
        quadtree_);
    if (sky_) pass_->renderer().set_sky(*sky_);
}

void SeaView::set_hull(std::optional<MooredHull> hull) {
    const bool floated = options_.hull.has_value();
    options_.hull = std::move(hull);
    if (options_.hull && !floated) make_ocean(SeaState(ocean_->sea()));
}

void SeaView::set_detail(const std::string& quality, gl::Shading shading) {
    options_.quality = quality;
    options_.shading = shading;
    quadtree_ = quadtree_preset_named(quality)->options(options_.size_m);
    pass_->set_quadtree(quadtree_);
    pass_->renderer().set_shading(shading);
}

void SeaView::show(const gl::Sky& sky) {
    sky_ = &sky;
    pass_->renderer().set_sky(sky);
}

void SeaView::set_light(const gl::SkyOptions& sky, float stops) {
    require(check(sky));
    stops_ = stops;
    if (!has_baked_) {
        gl::SkyOptions clear = sky;
        clear.cloud_cover = 0;
        plain_.schedule(clear);
        show(plain_.complete());
    }
    next_light_ = sky;
}

bool SeaView::continue_baking(double budget_ms) {
    if (!is_baking_) {
        if (!next_light_) return true;
        baker_.schedule(*next_light_);
        next_light_.reset();
        is_baking_ = true;
    }
    const std::chrono::duration<double, std::milli> budget(budget_ms);
    if (!slices_->advance(std::chrono::duration_cast<std::chrono::nanoseconds>(budget))) return false;
    show(baker_.complete());
    has_baked_ = true;
    is_baking_ = false;
    return !next_light_;
}

float SeaView::exposure() const { return sky_->exposure * std::exp2(stops_); }

void SeaView::simulate(double time_s) {
    if (!sky_) set_light({}, 0);
    const gl::Stopwatch watch;
    frame_ = &ocean_->frame_at(time_s);
    if (options_.hull) options_.hull->follow(*frame_, time_s);
    simulate_ms_ = watch.milliseconds();
    pass_->upload(*frame_);
}

void SeaView::draw(std::span<const gl::Eye> eyes, std::optional<float> wanted_exposure) {
    {
        const gl::GlStateGuard keep(gl_);  // enables all masks
        gl_.ClearColor(0, 0, 0, 1);
        gl_.ClearDepthf(1);
        gl_.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    }
    eye_m_ = {eyes[0].position_m.x, eyes[0].position_m.z};
    pass_->draw({.eyes = eyes, .exposure = wanted_exposure.value_or(exposure())});
}

}  // namespace pelagic::web
