#include "pelagic/viewer/view_image.hpp"

#include <algorithm>
#include <array>
#include <stdexcept>

#include "pelagic/floating/hull_plan.hpp"
#include "pelagic/gl/software_renderer.hpp"

namespace pelagic::viewer {
namespace {

constexpr int sky_face_size = 256;
/// Samples per pixel. A software driver uses a single sample for a reduced image, because four
/// samples double the time there.
constexpr int samples_a_pixel = 4;
/// Target frame times, ms: 30 frames/s on a GPU, 12 frames/s on a software driver, which otherwise
/// would need too small an image.
constexpr double gpu_goal_ms = 33, software_goal_ms = 80;
/// Initial scale on a software driver.
constexpr float software_first_scale = 0.42f;
/// A static view is drawn at full size once after this time, and the image is kept.
constexpr double still_s = 0.4;
/// At each of these scales the number of vertices along a patch's side is halved, because a smaller
/// image needs fewer vertices.
constexpr std::array halved_from = {0.72f, 0.55f, 0.36f};
constexpr int fewest_vertices = 8;
/// Cells of the dry space of the boat along it and across it, 5 cm each.
constexpr int dry_columns = 144, dry_rows = 50;

const QuadtreePreset& preset_named(const std::string& name) {
    const QuadtreePreset* preset = quadtree_preset_named(name);
    if (!preset) throw std::invalid_argument("no quality is called " + name);
    return *preset;
}

gl::ExclusionMap interior_of_boat() {
    const gl::Boat::Surface interior = gl::Boat::interior();
    return gl::ExclusionMap(plan_of(HullMesh(interior.vertices, interior.triangles), dry_columns, dry_rows));
}

}  // namespace

ViewImage::ViewImage(const gl::Functions& gl, const ViewOptions& options, const ViewSettings& settings,
                     ViewStatistics& statistics)
    : gl_(gl),
      options_(options),
      settings_(settings),
      statistics_(statistics),
      baker_(make_default_executor(options.threads), sky_face_size),
      boat_(gl),
      boat_interior_(interior_of_boat()),
      view_(gl),
      shown_sky_(settings.sky),
      is_software_(gl::is_software_renderer(reinterpret_cast<const char*>(gl.GetString(GL_RENDERER)))),
      fixed_shading_(settings.shading),
      scale_by_time_(scale_from(is_software_ ? software_first_scale : 1)) {
    baker_.schedule(shown_sky_);
    statistics_.sky_is_baking = true;
    statistics_.shading =
        settings.scale_is_automatic ? scale_by_time_.step().shading : fixed_shading_.value_or(gl::Shading::high);
}

RenderScale ViewImage::scale_from(float first) const {
    return RenderScale(is_software_ ? software_goal_ms : gpu_goal_ms, fixed_shading_, first);
}

void ViewImage::follow_settings(const Ocean& ocean) {
    if (statistics_.sky_is_baking && pass_ && baker_.is_done()) apply_sky();
    if (!statistics_.sky_is_baking && settings_.sky != shown_sky_) {
        shown_sky_ = settings_.sky;
        baker_.schedule(shown_sky_);
        statistics_.sky_is_baking = true;
    }
    if (!pass_ || settings_.quality != quality_ || settings_.surface != surface_) {
        quality_ = settings_.quality;
        surface_ = settings_.surface;
        open_pass(ocean);
    }
    if (settings_.shading != fixed_shading_) {
        fixed_shading_ = settings_.shading;
        scale_by_time_ = scale_from(scale_by_time_.step().scale);
    }
}

QuadtreeOptions ViewImage::quadtree_of(int vertices) const {
    const QuadtreePreset& preset = preset_named(quality_);
    const double size_m = settings_.size_m;
    QuadtreeOptions quadtree =
        surface_ == gl::Surface::open ? preset.options_near_water(size_m) : preset.options(size_m);
    quadtree.vertices = vertices;
    return quadtree;
}

void ViewImage::open_pass(const Ocean& ocean) {
    pass_.reset();
    pass_.emplace(gl_,
                  gl::RendererOptions{.resolution = ocean.resolution(),
                                      .cascades = ocean.cascade_count(),
                                      .shading = statistics_.shading,
                                      .writes = gl::PixelKind::radiance,
                                      .surface = surface_,
                                      .executor = make_default_executor(options_.threads),
                                      .dynamic_waves = true},
                  quadtree_of(preset_named(quality_).vertices), gl::CausticsBaking::while_drawn);
    gl::SeaRenderer& renderer = pass_->renderer();
    renderer.set_water(settings_.water);
    renderer.set_floor(options_.floor);
    if (settings_.flow) renderer.set_flow(*settings_.flow);
    renderer.set_exclusion_maps({&boat_interior_, 1});
    apply_sky();
}

void ViewImage::apply_sky() {
    const gl::Sky& sky = baker_.complete();
    statistics_.sky_is_baking = false;
    pass_->renderer().set_sky(sky);
    sky_ = &sky;
    luminance_of_unit_ = sky.luminance_of_unit();
    unmetered_ev_ = gl::ev_of_exposure(sky.exposure, luminance_of_unit_);
    ++changes_;
}

/// Returns the scale and the shading of this frame, or nothing if the last image shows it.
std::optional<RenderStep> ViewImage::next_step(const Drawn& now, bool is_saved, double passed_s) {
    still_for_s_ = now == drawn_ ? still_for_s_ + passed_s : 0;
    const bool is_still = settings_.scale_is_automatic && still_for_s_ >= still_s;
    // Full size is used for saved images, and for a frozen sea with a static camera.
    const bool is_by_time = settings_.scale_is_automatic && !is_still && !is_saved;
    RenderStep step{settings_.scale_is_automatic ? 1 : settings_.fixed_scale,
                    settings_.shading.value_or(gl::Shading::high)};
    if (is_by_time) step = scale_by_time_.step();
    const bool is_needed = now != drawn_ || (is_still && drawn_step_ != step) || is_saved ||
                           step.scale > drawn_step_.scale || step.shading > drawn_step_.shading;
    was_drawn_by_time_ = is_needed && is_by_time;
    return is_needed ? std::optional(step) : std::nullopt;
}

void ViewImage::adapt_to(double frame_ms) {
    if (was_drawn_by_time_) scale_by_time_.follow(frame_ms);
}

void ViewImage::draw(const Frame& frame, ViewScene& scene, const Camera& camera, glm::ivec2 size, bool is_saved,
                     double passed_s) {
    view_.follow(settings_.camera, unmetered_ev_, passed_s);
    statistics_.ev = view_.ev();
    const Drawn now{camera, frame.time_s, size, settings_.wireframe, changes_ + scene.changes()};
    if (const auto step = next_step(now, is_saved, passed_s)) {
        prepare(*step, size);
        draw_sea(frame, scene, camera, !is_software_ || is_saved);
        drawn_ = now;
        drawn_step_ = *step;
    }
    if (settings_.wireframe)
        wireframe_->show(size.x, size.y, size.x, size.y);
    else
        view_.show(settings_.camera, size.x, size.y);
}

/// Sets the shading, chooses a coarser mesh for a smaller image, and binds the image's target. Lines
/// of a wireframe are display colours, without exposure and tone curve.
void ViewImage::prepare(const RenderStep& step, glm::ivec2 size) {
    statistics_.shading = step.shading;
    pass_->renderer().set_shading(step.shading);
    const auto halvings = std::ranges::count_if(halved_from, [&](float from) { return step.scale <= from; });
    const int vertices = std::max(preset_named(quality_).vertices >> halvings, fewest_vertices);
    if (vertices != pass_->selection().options().vertices) pass_->set_quadtree(quadtree_of(vertices));
    if (settings_.wireframe) {
        if (!wireframe_ || wireframe_->width() != size.x || wireframe_->height() != size.y) {
            wireframe_.reset();
            wireframe_.emplace(gl_, size.x, size.y, samples_a_pixel);
        }
        wireframe_->clear();
    } else {
        view_.begin(size.x, size.y, step.scale, is_software_ && step.scale < 1 ? 0 : samples_a_pixel);
    }
    statistics_.drawn_width = settings_.wireframe ? size.x : view_.width();
    statistics_.drawn_height = settings_.wireframe ? size.y : view_.height();
}

/// \param reflects_boat  true on a GPU and for a saved image
void ViewImage::draw_sea(const Frame& frame, ViewScene& scene, const Camera& camera, bool reflects_boat) {
    const gl::Eye eye = gl::eye_of(camera, {0, 0, statistics_.drawn_width, statistics_.drawn_height});
    const float exposure = gl::exposure_of_ev(view_.ev(), luminance_of_unit_);
    gl::DrawInput input{.eyes = {&eye, 1},
                        .mode = settings_.wireframe ? gl::DrawMode::wireframe : gl::DrawMode::shaded,
                        .exposure = exposure,
                        .crest_glow = settings_.crest_glow,
                        .weighs_samples = true,
                        .spray = {.droplets = scene.droplets(frame)}};
    gl::Exclusion dry;
    if (const std::optional<SteeredBoat>& boat = scene.boat()) {
        const glm::dmat4 pose = boat->world_from_boat();
        boat_.set_light(*sky_, pass_->renderer().sunlit_at({pose[3].x, pose[3].z}));
        if (!settings_.wireframe) boat_.draw(eye, pose, exposure);
        if (!settings_.wireframe && reflects_boat) input.application_scene = boat_.image(eye, pose);
        dry = {.position_m = boat->hull().mesh_origin_m(boat->state()), .orientation = boat->state().orientation};
        input.exclusions = {&dry, 1};
    }
    statistics_.drawn = pass_->draw(input);
    statistics_.patches = pass_->selection().list().instances.size();
    if (!settings_.wireframe) view_.end(luminance_of_unit_);
}

}  // namespace pelagic::viewer
