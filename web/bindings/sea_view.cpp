#include "pelagic/web/bindings/sea_view.hpp"

#include <cmath>
#include <vector>

#include "pelagic/gl/gl_state_guard.hpp"
#include "pelagic/gl/stopwatch.hpp"
#include "pelagic/jobs/sliced_executor.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/message/require.hpp"

namespace pelagic::web {
namespace {

/// Texels along a side of the coarse sky without clouds, drawn until the first sky is baked.
constexpr int plain_face_size = 16;

QuadtreeOptions quadtree_of(const ViewOptions& options) {
    const QuadtreePreset* const preset = quadtree_preset_named(options.quality);
    if (!preset) {
        std::string names;
        for (const QuadtreePreset& one : quadtree_presets()) names.append(names.empty() ? "" : ", ").append(one.name);
        throw std::invalid_argument(invalid_value_message("quality", options.quality, "one of " + names));
    }
    return preset->options(options.size_m);
}

}  // namespace

struct SeaView::State {
    State(const gl::Functions& functions, const SeaState& sea, const ViewOptions& wanted)
        : gl(functions),
          options(wanted),
          selection(quadtree_of(wanted)),
          plain(executor, plain_face_size),
          baker(slices, wanted.sky_face_size) {
        take(sea);
    }

    /// Replaces the ocean. Keeps the renderer if resolution and number of cascades are equal.
    void take(const SeaState& sea) {
        auto next = std::make_unique<Ocean>(
            sea, OceanOptions{.executor = executor, .queries = true, .slopes = true, .foam = options.foam});
        const bool fits =
            renderer && next->resolution() == ocean->resolution() && next->cascade_count() == ocean->cascade_count();
        ocean = std::move(next);
        frame = nullptr;
        if (fits) return;
        renderer =
            std::make_unique<gl::SeaRenderer>(gl, gl::RendererOptions{.patch_vertices = selection.options().vertices,
                                                                      .resolution = ocean->resolution(),
                                                                      .cascades = ocean->cascade_count(),
                                                                      .shading = options.shading});
        if (sky) renderer->set_sky(*sky);
    }

    void show(const gl::Sky& baked) {
        sky = &baked;
        renderer->set_sky(baked);
    }

    const gl::Functions& gl;
    ViewOptions options;
    std::shared_ptr<Executor> executor = make_serial_executor();
    std::shared_ptr<SlicedExecutor> slices = make_sliced_executor();
    std::unique_ptr<Ocean> ocean;
    Selection selection;
    gl::SkyBaker plain, baker;
    std::unique_ptr<gl::SeaRenderer> renderer;
    const gl::Sky* sky = nullptr;  ///< drawn by the renderer
    bool has_baked = false;        ///< a baked sky is drawn
    bool is_baking = false;
    std::optional<gl::SkyOptions> next_light;  ///< to be baked next
    float stops = 0;
    const Frame* frame = nullptr;
    double simulate_ms = 0;
};

SeaView::SeaView(const gl::Functions& gl, const SeaState& sea, const ViewOptions& options)
    : state_(std::make_unique<State>(gl, sea, options)) {}
SeaView::~SeaView() = default;

void SeaView::set_sea(const SeaState& sea) { state_->take(sea); }

void SeaView::set_light(const gl::SkyOptions& sky, float stops) {
    State& s = *state_;
    require(check(sky));
    s.stops = stops;
    if (!s.has_baked) {
        gl::SkyOptions clear = sky;
        clear.cloud_cover = 0;
        s.plain.schedule(clear);
        s.show(s.plain.complete());
    }
    s.next_light = sky;
}

bool SeaView::continue_baking(double budget_ms) {
    State& s = *state_;
    if (!s.is_baking) {
        if (!s.next_light) return true;
        s.baker.schedule(*s.next_light);
        s.next_light.reset();
        s.is_baking = true;
    }
    const std::chrono::duration<double, std::milli> budget(budget_ms);
    if (!s.slices->advance(std::chrono::duration_cast<std::chrono::nanoseconds>(budget))) return false;
    s.show(s.baker.complete());
    s.has_baked = true;
    s.is_baking = false;
    return !s.next_light;
}

bool SeaView::has_sky() const { return !state_->is_baking && !state_->next_light; }

ShownLight SeaView::light() const {
    const gl::Sky& sky = *state_->sky;
    return {sky.sun_direction, sky.sun_irradiance, sky.sky_irradiance, sky.exposure * std::exp2(state_->stops)};
}

const Frame& SeaView::simulate(double time_s) {
    State& s = *state_;
    if (!s.sky) set_light({}, 0);
    const gl::Stopwatch watch;
    s.frame = &s.ocean->frame_at(time_s);
    s.simulate_ms = watch.milliseconds();
    s.renderer->upload(*s.frame);
    return *s.frame;
}

double SeaView::simulate_ms() const { return state_->simulate_ms; }
const Frame& SeaView::frame() const { return *state_->frame; }
const Ocean& SeaView::ocean() const { return *state_->ocean; }
const gl::DrawStatistics& SeaView::statistics() const { return state_->renderer->statistics(); }

void SeaView::draw(std::span<const gl::Eye> eyes, std::optional<float> exposure) {
    State& s = *state_;
    std::vector<glm::dmat4> views;
    glm::dvec3 viewer(0);
    for (const gl::Eye& eye : eyes) {
        views.push_back(eye.clip_from_world);
        viewer += eye.position_m / static_cast<double>(eyes.size());
    }
    const DrawList& list = s.selection.select({.viewer_m = viewer,
                                               .views = views,
                                               .bounds = s.frame->bounds,
                                               .sea_level_m = s.frame->water_frame.sea_level_m});
    {
        const gl::GlStateGuard keep(s.gl);  // enables all masks
        s.gl.ClearColor(0, 0, 0, 1);
        s.gl.ClearDepthf(1);
        s.gl.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    }
    s.renderer->draw({.eyes = eyes,
                      .viewer_m = viewer,
                      .list = &list,
                      .lod_scale = s.selection.options().lod_scale,
                      .exposure = exposure.value_or(light().exposure),
                      .camera_water_plane = gl::camera_water_plane(SurfaceQuery(*s.frame), viewer)});
}

}  // namespace pelagic::web
