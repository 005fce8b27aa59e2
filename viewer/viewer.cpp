#include "pelagic/viewer/viewer.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <array>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <vector>

#include "pelagic/floating/hull_plan.hpp"
#include "pelagic/gl/meshes/boat.hpp"
#include "pelagic/gl/software_renderer.hpp"
#include "pelagic/gl/stopwatch.hpp"
#include "pelagic/gl/water/exclusions.hpp"
#include "pelagic/gl/water/sea_renderer.hpp"
#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/viewer/camera_view.hpp"
#include "pelagic/viewer/panel_renderer.hpp"
#include "pelagic/viewer/picked_place.hpp"
#include "pelagic/viewer/render_scale.hpp"
#include "pelagic/viewer/stage_times.hpp"
#include "pelagic/viewer/steered_boat.hpp"
#include "pelagic/viewer/view_spray.hpp"
#include "pelagic/viewer/window.hpp"

namespace pelagic::viewer {
namespace {

constexpr int sky_face_size = 256;
constexpr double radians_a_pixel = 0.004;
constexpr double slowest_mps = 8;  // minimum flying speed; the speed grows with height
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

/// Upper limit of the time to bake a spectrum while frames are drawn.
constexpr double baking_s = 0.1;
constexpr double min_change_s = 0.1;

/// Dynamic-wave grid: large enough for a boat's wake, of which only the crests behind the stern
/// break. Computing a tick takes about 0.14 ms.
constexpr DynamicWavesOptions dynamic_waves{.resolution = 256, .side_m = 128, .border_m = 16, .foam_height_m = 0.35};
/// Limits of movement and duration for a click, which makes a splash instead of rotating the
/// camera.
constexpr float max_pixels_of_a_click = 4;
constexpr double max_s_of_a_click = 0.4;
constexpr double splash_reach_m = 400;
constexpr Disturbance splash{.mode = Disturbance::Mode::impulse, .radius_m = 1.2, .height_m = 1};
/// Distance ahead of the camera at which a boat is placed.
constexpr double boat_ahead_m = 22;
/// Cells of the dry space of the boat along it and across it, 5 cm each.
constexpr int dry_columns = 144, dry_rows = 50;
/// Waves of a millimetre, for a boat on small water, whose waves are only drawn.
const SeaState still_water{.resolution = 16, .patch_size_m = 100, .wind_speed_mps = 0.05};

bool same_sea(const SeaState& a, const SeaState& b) {
    if (a.waves != b.waves || a.spectrum != b.spectrum || a.spreading != b.spreading) return false;
    return std::ranges::all_of(sea_state_fields(),
                               [&](const SeaStateField& field) { return field.value_in(a) == field.value_in(b); });
}

bool is_software(const gl::Functions& functions) {
    return gl::is_software_renderer(reinterpret_cast<const char*>(functions.GetString(GL_RENDERER)));
}

/// The inputs of a drawn image, for comparison. `changes` counts changes of all other inputs.
struct Drawn {
    glm::dvec3 position_m{}, target_m{};
    double vertical_view_rad = 0, time_s = 0;
    int window_width = 0, window_height = 0;
    bool wireframe = false;
    unsigned long long changes = 0;

    bool operator==(const Drawn&) const = default;
};

const QuadtreePreset& preset_named(const std::string& name) {
    const QuadtreePreset* preset = quadtree_preset_named(name);
    if (!preset) throw std::invalid_argument("no quality is called " + name);
    return *preset;
}

/// Owns the Dear ImGui context and its input handling. \pre the window outlives this object
class PanelInput {
   public:
    explicit PanelInput(GLFWwindow* window) {
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;  // writes no file to the working directory
        ImGui::StyleColorsDark();
        ImGui::GetStyle().Colors[ImGuiCol_WindowBg].w = 0.82f;
        ImGui_ImplGlfw_InitForOther(window, true);
    }
    ~PanelInput() {
        ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext();
    }
    PanelInput(const PanelInput&) = delete;
    PanelInput& operator=(const PanelInput&) = delete;
};

class Viewer {
   public:
    explicit Viewer(const ViewOptions& options)
        : options_(options),
          settings_(options.settings),
          window_(options.width, options.height, "Pelagic"),
          input_(window_.handle()),
          panel_renderer_(window_.functions(), Window::get_proc_address()),
          image_(window_.functions()),
          is_software_(is_software(window_.functions())),
          scale_by_time_(scale_from(is_software_ ? software_first_scale : 1)),
          followed_shading_(settings_.shading),
          shown_sea_(settings_.sea),
          baker_(make_default_executor(options.threads), sky_face_size),
          shown_sky_(settings_.sky),
          caustics_(make_default_executor(options.threads)),
          camera_(options.camera) {
        baker_.schedule(settings_.sky);
        create_ocean(options_.changes);
        statistics_.shading = settings_.scale_is_automatic ? scale_by_time_.step().shading
                                                           : settings_.shading.value_or(gl::Shading::high);
        choose_quality();
        apply_sky();
    }

    ViewResult run() {
        gl::Stopwatch since_start;
        double last_s = 0;
        while (!window_.should_close()) {
            window_.poll();
            const double now_s = since_start.milliseconds() / 1000;
            const double passed_s = std::min(now_s - last_s, 0.25);  // avoids a jump after a pause
            statistics_.frame_ms = (now_s - last_s) * 1000;
            last_s = now_s;
            if (!settings_.frozen) time_s_ += passed_s;
            take_input(passed_s);
            follow_settings();
            if (window_.width() > 0 && window_.height() > 0) draw_frame(passed_s);
            window_.swap();
            ++frames_;
            if (sea_was_drawn_ && settings_.scale_is_automatic)
                scale_by_time_.follow(since_start.milliseconds() - now_s * 1000);
        }
        return {.settings = settings_,
                .camera = camera_.camera(),
                .time_s = shown_time_s_,
                .width = window_.width(),
                .height = window_.height(),
                .frames = frames_,
                .renderer = reinterpret_cast<const char*>(window_.functions().GetString(GL_RENDERER))};
    }

   private:
    RenderScale scale_from(float first) const {
        return RenderScale(is_software_ ? software_goal_ms : gpu_goal_ms, settings_.shading, first);
    }

    void take_input(double passed_s) {
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
        const ImGuiIO& io = ImGui::GetIO();
        if (!io.WantTextInput) {
            for (const int key : window_.pressed_keys()) {
                if (key == GLFW_KEY_ESCAPE) window_.close();
                if (key == GLFW_KEY_H) shows_panel_ = !shows_panel_;
                if (key == GLFW_KEY_P) takes_image_ = true;
                if (key == GLFW_KEY_B) boat_is_requested_ = !boat_is_requested_;
            }
            const auto held = [](int key) { return ImGui::IsKeyDown(key) ? 1.0 : 0.0; };
            const double metres = passed_s * std::max(slowest_mps, std::abs(camera_.camera().position_m.y));
            camera_.move(metres * glm::dvec3(held(GLFW_KEY_D) - held(GLFW_KEY_A), held(GLFW_KEY_R) - held(GLFW_KEY_F),
                                             held(GLFW_KEY_W) - held(GLFW_KEY_S)));
            helm_ = {held(GLFW_KEY_UP) - held(GLFW_KEY_DOWN), held(GLFW_KEY_RIGHT) - held(GLFW_KEY_LEFT)};
        }
        if (io.WantCaptureMouse) return;
        if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
            io.MouseDragMaxDistanceSqr[0] <= max_pixels_of_a_click * max_pixels_of_a_click &&
            static_cast<double>(io.MouseDownDurationPrev[0]) <= max_s_of_a_click)
            clicked_ = glm::dvec2(io.MousePos.x, io.MousePos.y);
        // In the frame of a press, io.MouseDelta would include the movement before the press.
        if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) camera_.turn(radians_a_pixel * window_.dragged_px());
        if (io.MouseWheel != 0) camera_.zoom(std::pow(0.9, static_cast<double>(io.MouseWheel)));
    }

    /// Starts the work for changed settings, and applies completed results. Does not wait.
    void follow_settings() {
        if (statistics_.sky_is_baking && baker_.is_done()) {
            apply_sky();
            statistics_.sky_is_baking = false;
        }
        if (!statistics_.sky_is_baking && settings_.sky != shown_sky_) {
            shown_sky_ = settings_.sky;
            baker_.schedule(shown_sky_);
            statistics_.sky_is_baking = true;
        }
        if (!statistics_.sea_is_baking && !same_sea(settings_.sea, shown_sea_)) {
            if (!check(settings_.sea).empty()) {
                settings_.sea = shown_sea_;  // a slider made the sea state invalid
            } else if (is_in_transition()) {
                // The next transition starts at the end of the current one.
            } else if (starts_transition()) {
                shown_sea_ = settings_.sea;
            } else if (ocean_supports(settings_.sea)) {
                shown_sea_ = settings_.sea;
                ocean_->schedule_sea(shown_sea_);
                if (spray_) spray_->ocean().schedule_sea(shown_sea_);
                statistics_.sea_is_baking = true;
            } else {
                create_ocean();
                choose_quality();
            }
        }
        if (settings_.quality != quality_ || settings_.surface != surface_) choose_quality();
        if (settings_.shading != followed_shading_) {
            followed_shading_ = settings_.shading;
            scale_by_time_ = scale_from(scale_by_time_.step().scale);
        }
    }

    /// Returns true during a transition that the user started in the viewer.
    bool is_in_transition() const {
        const std::vector<SeaChange>& changes = ocean_->forecast().changes;
        const double remaining_s = changes.empty() ? 0 : changes.back().end_s() - time_s_;
        return !settings_.frozen && remaining_s > 0 && remaining_s <= settings_.change_over_s + baking_s;
    }

    /// Schedules a transition to the chosen sea state. Returns false if it is not possible.
    bool starts_transition() {
        if (settings_.frozen || settings_.change_over_s < min_change_s) return false;
        try {
            ocean_->schedule_sea(settings_.sea, time_s_ + baking_s, settings_.change_over_s);
            if (spray_) spray_->ocean().schedule_sea(settings_.sea, time_s_ + baking_s, settings_.change_over_s);
        } catch (const std::invalid_argument&) {
            // The sea has longer waves or other cascades, or a later transition is already
            // scheduled.
            return false;
        }
        return true;
    }

    /// Returns true if the ocean can change to that sea state. An ocean's number of cascades,
    /// resolution and kind of waves are fixed; with a shore, its sea state is fixed too.
    bool ocean_supports(const SeaState& sea) const {
        return !options_.shore && cascades_of(sea) == static_cast<int>(ocean_->cascade_count()) &&
               resolution_of(sea) == ocean_->resolution() &&
               (sea.waves == WaveModel::pond) == (ocean_->sea().waves == WaveModel::pond);
    }

    void create_ocean(const std::vector<SeaChange>& changes = {}) {
        complete_caustics();  // the caustics jobs read the old ocean
        shown_sea_ = settings_.sea;
        const bool has_shore = options_.shore && check(*options_.shore, shown_sea_).empty();
        ocean_.emplace(Forecast{.first = shown_sea_, .changes = changes},
                       OceanOptions{.executor = make_default_executor(options_.threads),
                                    .trace = stage_times_,
                                    .queries = true,
                                    .velocities = true,
                                    .slopes = true,
                                    .foam = true,
                                    .dynamic_waves = dynamic_waves,
                                    .shore = has_shore ? options_.shore : std::nullopt});
        ocean_->set_water_frame(options_.water_frame);
        spray_.reset();
        if (options_.spray.value_or(true))
            spray_ = std::make_unique<ViewSpray>(Forecast{.first = shown_sea_, .changes = changes},
                                                 OceanOptions{.executor = make_default_executor(options_.threads),
                                                              .shore = has_shore ? options_.shore : std::nullopt});
        if (spray_) spray_->ocean().set_water_frame(options_.water_frame);
        if (boat_) boat_->float_on(ocean_->dynamic_waves());
        ocean_->dynamic_waves().set_center(grid_centre_.x, grid_centre_.y);
        stage_times_->follow(ocean_->graph());
        ocean_->schedule(time_s_);
    }

    bool draws_spray() const {
        const bool is_wanted = options_.spray.value_or(statistics_.shading != gl::Shading::headset);
        return spray_ && is_wanted && surface_ == gl::Surface::open && !settings_.wireframe;
    }

    void apply_sky() {
        const gl::Sky& sky = baker_.complete();
        renderer_->set_sky(sky);
        if (boat_model_) boat_model_->set_light(sky);
        luminance_of_unit_ = sky.luminance_of_unit();
        unmetered_ev_ = gl::ev_of_exposure(sky.exposure, luminance_of_unit_);
        ++changes_;
    }

    /// Recreates textures and meshes, which depend on the quality and on the cascades, and uploads
    /// the sky again.
    void choose_quality() {
        quality_ = settings_.quality;
        surface_ = settings_.surface;
        renderer_ = nullptr;
        for (auto& renderer : renderers_) renderer.reset();
        choose_mesh(preset_named(quality_).vertices);
        choose_shading(statistics_.shading);
    }

    /// Selects the renderer of a shading. Renderers are kept, so that a change costs only an upload
    /// of the sky and no compilation of shaders.
    void choose_shading(gl::Shading shading) {
        statistics_.shading = shading;
        auto& renderer = renderers_[static_cast<std::size_t>(shading)];
        if (!renderer) {
            renderer = std::make_unique<gl::SeaRenderer>(
                window_.functions(), gl::RendererOptions{.patch_vertices = selection_->options().vertices,
                                                         .resolution = ocean_->resolution(),
                                                         .cascades = ocean_->cascade_count(),
                                                         .shading = shading,
                                                         .writes = gl::PixelKind::radiance,
                                                         .surface = surface_,
                                                         .executor = make_default_executor(options_.threads),
                                                         .dynamic_waves = true});
            renderer->set_water(settings_.water);
            renderer->set_floor(options_.floor);
            if (settings_.flow) renderer->set_flow(*settings_.flow);
            if (boat_interior_) renderer->set_exclusion_maps({&*boat_interior_, 1});
        }
        renderer_ = renderer.get();
        renderer_->set_patch_vertices(selection_->options().vertices);
        if (has_caustics_) {
            renderer_->set_caustics(caustics_.complete());
            caustics_are_baking_ = false;
        }
        if (!statistics_.sky_is_baking && frames_ > 0) apply_sky();
    }

    void choose_mesh(int vertices) {
        const QuadtreePreset& preset = preset_named(quality_);
        QuadtreeOptions quadtree = surface_ == gl::Surface::open ? preset.options_near_water(settings_.size_m)
                                                                 : preset.options(settings_.size_m);
        quadtree.vertices = vertices;
        selection_.emplace(quadtree);
        if (renderer_) renderer_->set_patch_vertices(vertices);
        ++changes_;
    }

    /// Chooses a coarser mesh for a smaller image.
    void fit_mesh_to(float scale) {
        const auto halvings = std::ranges::count_if(halved_from, [&](float from) { return scale <= from; });
        const int vertices = std::max(preset_named(quality_).vertices >> halvings, fewest_vertices);
        if (vertices != selection_->options().vertices) choose_mesh(vertices);
    }

    /// Completes the frame that was scheduled during the last image, and schedules the next one,
    /// which is computed while this one is drawn.
    const Frame& next_frame() {
        const Frame& frame = ocean_->complete();
        stage_times_->end_frame();
        if (statistics_.sea_is_baking && ocean_->sea_is_ready()) {
            ocean_->complete_sea();
            if (spray_) spray_->complete_sea();
            statistics_.sea_is_baking = false;
            ++changes_;
        }
        statistics_.sea_is_changing = ocean_->forecast().at(time_s_).weight > 0;
        // The caustics jobs read the previous frame, whose views the next schedule() invalidates.
        complete_caustics();
        if (!settings_.frozen) disturb_water(frame);
        ocean_->schedule(time_s_);
        return frame;
    }

    /// Enqueues splashes and the boat's pressure for the next ticks, and keeps the grid at its
    /// place, from which a current carries it.
    void disturb_water(const Frame& frame) {
        const SurfaceQuery query(frame);
        if (clicked_) make_splash(query);
        clicked_.reset();
        if (boat_is_requested_ != boat_.has_value()) boat_is_requested_ ? place_boat(frame) : remove_boat();
        if (!boat_) return ocean_->dynamic_waves().set_center(grid_centre_.x, grid_centre_.y);
        const glm::dvec2 before = boat_->place_m();
        boat_->advance(boat_water(frame), frame.time_s - boat_time_s_, helm_);
        boat_time_s_ = frame.time_s;
        if (settings_.follows_boat) camera_.go_along(boat_->place_m() - before);
        if (draws_spray()) spray_->emit(boat_->thrown().emitters());
        for (const Disturbance& foam : boat_->thrown().foam()) ocean_->dynamic_waves().add_impulse(foam);
        ocean_->dynamic_waves().set_center(boat_->place_m().x, boat_->place_m().y);
        statistics_.boat_mps = boat_->speed_mps();
    }

    /// Returns the drawn water. Small water (gl::Surface) replaces the cascades, so their heights
    /// are left out.
    Frame boat_water(const Frame& frame) {
        if (surface_ == gl::Surface::open) return frame;
        if (!still_ocean_)
            still_ocean_.emplace(
                still_water, OceanOptions{.executor = make_serial_executor(), .queries = true, .velocities = true});
        Frame still = still_ocean_->frame_at(0);
        still.time_s = frame.time_s;
        still.water_frame = frame.water_frame;
        still.dynamic_waves = frame.dynamic_waves;
        return still;
    }

    void make_splash(const SurfaceQuery& query) {
        const glm::dvec2 window(ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y);
        const auto place = picked_place(query, camera_.camera(), *clicked_, window, splash_reach_m);
        if (!place) return;
        // Centres the dynamic-wave grid on the splash, unless it follows a boat.
        if (!boat_ && glm::length(*place - grid_centre_) > dynamic_waves.side_m / 4) {
            grid_centre_ = *place;
            ocean_->dynamic_waves().set_center(place->x, place->y);
        }
        Disturbance here = splash;
        here.x_m = place->x;
        here.z_m = place->y;
        ocean_->dynamic_waves().add_impulse(here);
    }

    void place_boat(const Frame& frame) {
        const Camera camera = camera_.camera();
        const glm::dvec2 ahead(camera.target_m.x - camera.position_m.x, camera.target_m.z - camera.position_m.z);
        const double heading = std::atan2(ahead.y, ahead.x);
        boat_.emplace(boat_water(frame),
                      glm::dvec2(camera.position_m.x, camera.position_m.z) +
                          boat_ahead_m * glm::dvec2(std::cos(heading), std::sin(heading)),
                      heading);
        boat_->float_on(ocean_->dynamic_waves());
        boat_time_s_ = frame.time_s;
        if (settings_.follows_boat) camera_.look_at({boat_->place_m().x, 1, boat_->place_m().y});
        if (boat_model_) return;
        boat_model_.emplace(window_.functions());
        if (!statistics_.sky_is_baking) boat_model_->set_light(baker_.complete());
        const gl::Boat::Surface interior = gl::Boat::interior();
        boat_interior_.emplace(plan_of(HullMesh(interior.vertices, interior.triangles), dry_columns, dry_rows));
        for (auto& renderer : renderers_)
            if (renderer) renderer->set_exclusion_maps({&*boat_interior_, 1});
    }

    void remove_boat() {
        grid_centre_ = boat_->place_m();
        boat_->leave_water();
        boat_.reset();
        statistics_.boat_mps.reset();
    }

    void complete_caustics() {
        if (!caustics_are_baking_) return;
        renderer_->set_caustics(caustics_.complete());
        caustics_are_baking_ = false;
        has_caustics_ = true;
    }

    /// Returns the water plane at the camera. Small water is nearly level, so its plane is level.
    gl::CameraWaterPlane camera_water_plane(const Frame& frame) const {
        if (surface_ != gl::Surface::open) return {.height_m = frame.water_frame.sea_level_m};
        return gl::camera_water_plane(SurfaceQuery(frame), camera_.camera().position_m);
    }

    /// Schedules caustics in every second frame. The jobs run while the next two frames are
    /// computed.
    void start_caustics(const Frame& frame) {
        const double above_water_m = camera_.camera().position_m.y - camera_water_plane(frame).height_m;
        if (frames_ % 2 == 1 || !gl::shows_caustics(options_.floor, frame.sea.depth_m, above_water_m)) return;
        caustics_.schedule(frame, {.depth_m = gl::caustics_depth_m(options_.floor, frame.sea.depth_m),
                                   .sun = gl::sun_direction(shown_sky_)});
        caustics_are_baking_ = true;
    }

    void draw_frame(double passed_s) {
        const Frame& frame = next_frame();
        start_caustics(frame);
        shown_time_s_ = frame.time_s;
        statistics_.cascade_sides_m.clear();
        for (const Cascade& cascade : frame.cascades) statistics_.cascade_sides_m.push_back(cascade.grid.side_m);
        statistics_.significant_wave_height_m = frame.statistics.significant_wave_height_m;
        image_.follow(settings_.camera, unmetered_ev_, passed_s);
        statistics_.ev = image_.ev();

        // Full size is used for saved images, and for a frozen sea with a static camera.
        const Camera camera = camera_.camera();
        const Drawn now{.position_m = camera.position_m,
                        .target_m = camera.target_m,
                        .vertical_view_rad = camera.vertical_view_rad,
                        .time_s = frame.time_s,
                        .window_width = window_.width(),
                        .window_height = window_.height(),
                        .wireframe = settings_.wireframe,
                        .changes = changes_};
        still_for_s_ = now == drawn_ ? still_for_s_ + passed_s : 0;
        const bool is_still = settings_.scale_is_automatic && still_for_s_ >= still_s;
        const RenderStep full_size{1, settings_.shading.value_or(gl::Shading::high)};
        RenderStep step = full_size;
        if (!settings_.scale_is_automatic)
            step.scale = settings_.fixed_scale;
        else if (!is_still && !takes_image_)
            step = scale_by_time_.step();
        sea_was_drawn_ = now != drawn_ || (is_still && drawn_step_ != step) || takes_image_ ||
                         step.scale > drawn_step_.scale || step.shading > drawn_step_.shading;
        if (sea_was_drawn_) {
            // A new renderer needs a completed sky.
            if (step.shading != statistics_.shading && !statistics_.sky_is_baking) choose_shading(step.shading);
            draw_sea(frame, camera, step.scale);
            drawn_ = now;
            drawn_.changes = changes_;  // draw_sea() may have changed the mesh
            drawn_step_ = {step.scale, statistics_.shading};
            // The time of a full-size image does not affect the scale of the next frames.
            sea_was_drawn_ = !is_still && !takes_image_;
        }
        show_sea();
        if (takes_image_) take_image();

        if (shows_panel_) show_panel(settings_, camera_, statistics_, stage_times_->rows());
        ImGui::Render();
        panel_renderer_.draw(*ImGui::GetDrawData());
    }

    void draw_sea(const Frame& frame, const Camera& camera, float scale) {
        fit_mesh_to(scale);
        const int width = window_.width(), height = window_.height();
        if (settings_.wireframe)
            begin_wireframe(width, height);
        else
            image_.begin(width, height, scale, is_software_ && scale < 1 ? 0 : samples_a_pixel);
        statistics_.drawn_width = settings_.wireframe ? width : image_.width();
        statistics_.drawn_height = settings_.wireframe ? height : image_.height();
        const gl::Eye eye = gl::eye_of(camera, {0, 0, statistics_.drawn_width, statistics_.drawn_height});
        const gl::Stopwatch select;
        const DrawList& list = selection_->select({.viewer_m = camera.position_m,
                                                   .views = {&eye.clip_from_world, 1},
                                                   .bounds = frame.bounds,
                                                   .sea_level_m = frame.water_frame.sea_level_m,
                                                   .depth = ClipDepth::minus_one_to_one});
        statistics_.select_us = select.milliseconds() * 1000;
        statistics_.patches = list.instances.size();
        renderer_->upload(frame);
        const float exposure = gl::exposure_of_ev(image_.ev(), luminance_of_unit_);
        gl::Exclusion dry;
        if (boat_)
            dry = {.position_m = boat_->hull().mesh_origin_m(boat_->state()),
                   .orientation = boat_->state().orientation};
        const gl::DrawStatistics& drawn =
            renderer_->draw({.eyes = {&eye, 1},
                             .viewer_m = camera.position_m,
                             .list = &list,
                             .lod_scale = selection_->options().lod_scale,
                             .mode = settings_.wireframe ? gl::DrawMode::wireframe : gl::DrawMode::shaded,
                             .exposure = exposure,
                             .crest_glow = settings_.crest_glow,
                             .weighs_samples = true,
                             .camera_water_plane = camera_water_plane(frame),
                             .application_scene = draw_boat(eye, exposure),
                             .exclusions = {&dry, boat_ ? 1u : 0u}});
        if (draws_spray())
            renderer_->draw_spray({.droplets = spray_->at(frame.time_s, camera.position_m, !settings_.frozen)});
        statistics_.upload_ms = drawn.upload_ms - drawn.upload_driver_ms;
        statistics_.draw_ms = drawn.draw_ms - drawn.draw_driver_ms;
        statistics_.draw_calls = drawn.sea_calls + drawn.sky_calls;
        statistics_.triangles = drawn.triangles;
        if (!settings_.wireframe) image_.end(luminance_of_unit_);
    }

    /// Draws the boat before the sea. On a GPU, or for a saved image, returns its image for
    /// reflections.
    std::optional<gl::ApplicationScene> draw_boat(const gl::Eye& eye, float exposure) {
        if (!boat_ || settings_.wireframe) return {};
        const glm::dmat4 pose = boat_->world_from_boat();
        boat_model_->draw(eye, pose, exposure);
        if (is_software_ && !takes_image_) return {};
        return boat_model_->image(eye, pose);
    }

    /// Prepares the wireframe target. Lines are display colours, without exposure and tone curve.
    void begin_wireframe(int width, int height) {
        if (!wireframe_ || wireframe_->width() != width || wireframe_->height() != height) {
            wireframe_.reset();
            wireframe_.emplace(window_.functions(), width, height, samples_a_pixel);
        }
        wireframe_->bind();
        window_.functions().ClearColor(0, 0, 0, 1);
        window_.functions().ClearDepthf(1);
        window_.functions().Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    }

    /// Draws the last image into the window.
    void show_sea() {
        const int width = window_.width(), height = window_.height();
        if (settings_.wireframe)
            wireframe_->show(width, height, width, height);
        else
            image_.show(settings_.camera, width, height);
    }

    /// Saves the image without the panel, which is drawn later.
    void take_image() {
        takes_image_ = false;
        const int width = window_.width(), height = window_.height();
        const auto row = static_cast<std::size_t>(width) * 4;
        std::vector<std::uint8_t> upwards(row * static_cast<std::size_t>(height)), pixels;
        window_.functions().PixelStorei(GL_PACK_ALIGNMENT, 4);
        window_.functions().ReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, upwards.data());
        for (int j = height - 1; j >= 0; --j) {
            const auto start = upwards.begin() + static_cast<std::ptrdiff_t>(row) * j;
            pixels.insert(pixels.end(), start, start + static_cast<std::ptrdiff_t>(row));
        }
        if (options_.save_image) options_.save_image(pixels, width, height);
    }

    const ViewOptions& options_;
    ViewSettings settings_;
    Window window_;
    PanelInput input_;
    PanelRenderer panel_renderer_;
    CameraView image_;
    bool is_software_;
    RenderScale scale_by_time_;
    std::optional<gl::Shading> followed_shading_;  ///< settings_.shading of scale_by_time_
    std::shared_ptr<StageTimes> stage_times_ = std::make_shared<StageTimes>();
    std::optional<Ocean> ocean_;
    std::unique_ptr<ViewSpray> spray_;
    SeaState shown_sea_;
    gl::SkyBaker baker_;
    gl::SkyOptions shown_sky_;
    gl::CausticsBaker caustics_;
    bool caustics_are_baking_ = false, has_caustics_ = false;
    ViewCamera camera_;
    std::string quality_;
    gl::Surface surface_ = gl::Surface::open;
    std::optional<Selection> selection_;
    std::array<std::unique_ptr<gl::SeaRenderer>, names_of<gl::Shading>().size()>
        renderers_;                        ///< by shading; created when first used
    gl::SeaRenderer* renderer_ = nullptr;  ///< renderer of statistics_.shading
    std::optional<gl::RenderTarget> wireframe_;
    float luminance_of_unit_ = 1, unmetered_ev_ = 15;  ///< values of the shown sky
    Drawn drawn_;
    RenderStep drawn_step_{0, gl::Shading::headset};
    double still_for_s_ = 0;
    bool sea_was_drawn_ = false;  ///< the last frame drew the sea at the scale of scale_by_time_
    unsigned long long changes_ = 0;
    ViewStatistics statistics_;
    bool shows_panel_ = true, takes_image_ = false;
    std::optional<glm::dvec2> clicked_;  ///< pixel of the window, from its upper left corner
    glm::dvec2 grid_centre_{};           ///< centre of the dynamic-wave grid while there is no boat
    Helm helm_;
    bool boat_is_requested_ = false;
    std::optional<SteeredBoat> boat_;
    double boat_time_s_ = 0;            ///< time of the boat's pose
    std::optional<Ocean> still_ocean_;  ///< of boat_water()
    std::optional<gl::Boat> boat_model_;
    std::optional<gl::ExclusionMap> boat_interior_;
    double time_s_ = 0, shown_time_s_ = 0;
    std::uint64_t frames_ = 0;
};

}  // namespace

ViewResult show_sea(const ViewOptions& options) { return Viewer(options).run(); }

}  // namespace pelagic::viewer
