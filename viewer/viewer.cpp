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

#include "pelagic/gl/meshes/boat.hpp"
#include "pelagic/gl/software_renderer.hpp"
#include "pelagic/gl/stopwatch.hpp"
#include "pelagic/gl/water/sea_renderer.hpp"
#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/viewer/camera_view.hpp"
#include "pelagic/viewer/panel_renderer.hpp"
#include "pelagic/viewer/picked_place.hpp"
#include "pelagic/viewer/render_scale.hpp"
#include "pelagic/viewer/stage_times.hpp"
#include "pelagic/viewer/steered_boat.hpp"
#include "pelagic/viewer/window.hpp"

namespace pelagic::viewer {
namespace {

constexpr int sky_face_size = 256;
constexpr double radians_a_pixel = 0.004;
constexpr double slowest_mps = 8;  // flying; faster with height
/// Without a GPU one, where the image is drawn smaller: four cost twice as much there.
constexpr int samples_a_pixel = 4;
/// What a frame may take before the image is drawn smaller, milliseconds: 30 a second; on a driver without a GPU 12 a second, so
/// that something is left to see.
constexpr double goal_ms = 33, software_goal_ms = 80;
/// Where a driver without a GPU begins.
constexpr float software_first_scale = 0.42f;
/// A view that rests for so long is drawn in full size once, and stays.
constexpr double rest_s = 0.4;
/// An image of fewer pixels needs fewer vertices: half as many along a patch's side at each of these scales.
constexpr std::array halved_from = {0.72f, 0.55f, 0.36f};
constexpr int fewest_vertices = 8;

/// A spectrum is baked in less, beside frames.
constexpr double baking_s = 0.1;
constexpr double min_change_s = 0.1;

/// The window in which the water answers: a tick is a seventh of a millisecond, and a boat's wake has room in it.
constexpr DynamicWavesOptions dynamic_waves{.resolution = 256, .side_m = 128, .border_m = 16};
constexpr double tick_s = 1.0 / dynamic_waves.ticks_per_s;
/// A click that makes a splash rather than turning the camera.
constexpr float max_pixels_of_a_click = 4;
constexpr double max_s_of_a_click = 0.4;
constexpr double splash_reach_m = 400;
constexpr Disturbance splash{.mode = Disturbance::Mode::impulse, .radius_m = 1.2, .height_m = 1};
/// Where a boat is put: so far ahead of the camera.
constexpr double boat_ahead_m = 22;

bool same_sea(const SeaState& a, const SeaState& b) {
    if (a.waves != b.waves || a.spectrum != b.spectrum || a.spreading != b.spreading) return false;
    return std::ranges::all_of(sea_state_fields(),
                               [&](const SeaStateField& field) { return field.value_in(a) == field.value_in(b); });
}

bool is_software(const gl::Functions& functions) {
    return gl::is_software_renderer(reinterpret_cast<const char*>(functions.GetString(GL_RENDERER)));
}

/// What a drawn image depends on, in one comparable piece; `changes` counts what else can change.
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

/// Dear ImGui and its input, for as long as the window is there.
class PanelInput {
   public:
    explicit PanelInput(GLFWwindow* window) {
        ImGui::CreateContext();
        ImGui::GetIO().IniFilename = nullptr;  // leaves no file where the user happens to be
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
        fill_ocean(options_.changes);
        statistics_.shading = settings_.scale_is_automatic ? scale_by_time_.step().shading
                                                           : settings_.shading.value_or(gl::Shading::high);
        choose_quality();
        take_sky();
    }

    ViewResult run() {
        gl::Stopwatch since_start;
        double last_s = 0;
        while (!window_.should_close()) {
            window_.poll();
            const double now_s = since_start.milliseconds() / 1000;
            const double passed_s = std::min(now_s - last_s, 0.25);  // no leaps after a pause
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
        return RenderScale(is_software_ ? software_goal_ms : goal_ms, settings_.shading, first);
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
                if (key == GLFW_KEY_B) wants_boat_ = !wants_boat_;
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
        // Not io.MouseDelta, which in the frame of a press holds the movement before it, too.
        if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) camera_.turn(radians_a_pixel * window_.dragged_px());
        if (io.MouseWheel != 0) camera_.zoom(std::pow(0.9, static_cast<double>(io.MouseWheel)));
    }

    /// Starts what the settings ask for, and takes over what is ready; nothing waits.
    void follow_settings() {
        if (statistics_.sky_is_baking && baker_.is_done()) {
            take_sky();
            statistics_.sky_is_baking = false;
        }
        if (!statistics_.sky_is_baking && settings_.sky != shown_sky_) {
            shown_sky_ = settings_.sky;
            baker_.schedule(shown_sky_);
            statistics_.sky_is_baking = true;
        }
        if (!statistics_.sea_is_baking && !same_sea(settings_.sea, shown_sea_)) {
            if (!check(settings_.sea).empty()) {
                settings_.sea = shown_sea_;  // a slider went where this sea can't
            } else if (is_about_to_settle()) {
                // The next change begins where this one ends.
            } else if (turns_slowly()) {
                shown_sea_ = settings_.sea;
            } else if (ocean_takes(settings_.sea)) {
                shown_sea_ = settings_.sea;
                ocean_->schedule_sea(shown_sea_);
                statistics_.sea_is_baking = true;
            } else {
                fill_ocean();
                choose_quality();
            }
        }
        if (settings_.quality != quality_ || settings_.surface != surface_) choose_quality();
        if (settings_.shading != followed_shading_) {
            followed_shading_ = settings_.shading;
            scale_by_time_ = scale_from(scale_by_time_.step().scale);
        }
    }

    /// In the middle of a change that was asked for here.
    bool is_about_to_settle() const {
        const std::vector<SeaChange>& changes = ocean_->forecast().changes;
        const double left_s = changes.empty() ? 0 : changes.back().end_s() - time_s_;
        return !settings_.frozen && left_s > 0 && left_s <= settings_.change_over_s + baking_s;
    }

    /// The sea turns into the one that is chosen, if that fits the cascades.
    bool turns_slowly() {
        if (settings_.frozen || settings_.change_over_s < min_change_s) return false;
        try {
            ocean_->schedule_sea(settings_.sea, time_s_ + baking_s, settings_.change_over_s);
        } catch (const std::invalid_argument&) {  // longer waves, another kind of cascades, or weather to come
            return false;
        }
        return true;
    }

    /// An ocean has its cascades, and what fills them, for life; one with a shore has its sea, too.
    bool ocean_takes(const SeaState& sea) const {
        return !options_.shore && cascades_of(sea) == static_cast<int>(ocean_->cascade_count()) &&
               resolution_of(sea) == ocean_->resolution() &&
               (sea.waves == WaveModel::pond) == (ocean_->sea().waves == WaveModel::pond);
    }

    void fill_ocean(const std::vector<SeaChange>& changes = {}) {
        take_caustics();  // they read the ocean that goes
        shown_sea_ = settings_.sea;
        const bool has_shore = options_.shore && check(*options_.shore, shown_sea_).empty();
        ocean_.emplace(Forecast{.first = shown_sea_, .changes = changes},
                       OceanOptions{.executor = make_default_executor(options_.threads),
                                    .trace = stage_times_,
                                    .queries = true,
                                    .slopes = true,
                                    .foam = true,
                                    .dynamic_waves = dynamic_waves,
                                    .shore = has_shore ? options_.shore : std::nullopt});
        boat_source_.reset();
        ocean_->dynamic_waves().set_center(window_middle_.x, window_middle_.y);
        stage_times_->follow(ocean_->graph());
        ocean_->schedule(time_s_);
    }

    void take_sky() {
        const gl::Sky& sky = baker_.complete();
        renderer_->set_sky(sky);
        if (boat_model_) boat_model_->set_light(sky);
        luminance_of_unit_ = sky.luminance_of_unit();
        unmetered_ev_ = gl::ev_of_exposure(sky.exposure, luminance_of_unit_);
        ++changes_;
    }

    /// Textures and meshes belong to the quality and to the cascades; the sky is uploaded again.
    void choose_quality() {
        quality_ = settings_.quality;
        surface_ = settings_.surface;
        renderer_ = nullptr;
        for (auto& renderer : renderers_) renderer.reset();
        choose_mesh(preset_named(quality_).vertices);
        choose_shading(statistics_.shading);
    }

    /// Those that were drawn once stay: to change between them costs an upload of the sky, and no shader is compiled again.
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
        }
        renderer_ = renderer.get();
        renderer_->set_patch_vertices(selection_->options().vertices);
        if (has_caustics_) {
            renderer_->set_caustics(caustics_.complete());
            caustics_are_baking_ = false;
        }
        if (!statistics_.sky_is_baking && frames_ > 0) take_sky();
    }

    void choose_mesh(int vertices) {
        QuadtreeOptions quadtree = preset_named(quality_).options(settings_.size_m);
        quadtree.vertices = vertices;
        selection_.emplace(quadtree);
        if (renderer_) renderer_->set_patch_vertices(vertices);
        ++changes_;
    }

    /// A coarser one where the image is small.
    void fit_mesh_to(float scale) {
        const auto halvings = std::ranges::count_if(halved_from, [&](float from) { return scale <= from; });
        const int vertices = std::max(preset_named(quality_).vertices >> halvings, fewest_vertices);
        if (vertices != selection_->options().vertices) choose_mesh(vertices);
    }

    /// The frame that was scheduled one image ago, then the next one: computed while this one is drawn.
    const Frame& next_frame(double passed_s) {
        const Frame& frame = ocean_->complete();
        stage_times_->end_frame();
        if (statistics_.sea_is_baking && ocean_->sea_is_ready()) {
            ocean_->complete_sea();
            statistics_.sea_is_baking = false;
            ++changes_;
        }
        statistics_.sea_is_changing = ocean_->forecast().at(time_s_).part > 0;
        // They read the frame before this one, whose views end with the next schedule().
        take_caustics();
        if (!settings_.frozen) disturb_water(frame, passed_s);
        ocean_->schedule(time_s_);
        return frame;
    }

    /// Splashes and the boat, for the ticks to come.
    void disturb_water(const Frame& frame, double passed_s) {
        const SurfaceQuery query(frame);
        if (clicked_) make_splash(query);
        clicked_.reset();
        if (wants_boat_ != boat_.has_value()) wants_boat_ ? put_boat() : take_boat();
        if (!boat_) return;
        const glm::dvec2 before = boat_->place_m();
        boat_->step(
            passed_s, helm_, [&](double x, double z) { return drawn_height(query, x, z); }, frame.time_s);
        if (settings_.follows_boat) camera_.go_along(boat_->place_m() - before);
        const Disturbance press = boat_->press(frame.time_s, tick_s);
        if (!boat_source_) boat_source_ = ocean_->dynamic_waves().add_source(press);
        ocean_->dynamic_waves().set_source(*boat_source_, press);
        ocean_->dynamic_waves().set_center(boat_->place_m().x, boat_->place_m().y);
        statistics_.boat_mps = boat_->speed_mps();
    }

    void make_splash(const SurfaceQuery& query) {
        const glm::dvec2 window(ImGui::GetIO().DisplaySize.x, ImGui::GetIO().DisplaySize.y);
        const auto place = picked_place(query, camera_.camera(), *clicked_, window, splash_reach_m);
        if (!place) return;
        // The window goes where it is needed, unless a boat needs it.
        if (!boat_ && glm::length(*place - window_middle_) > dynamic_waves.side_m / 4) {
            window_middle_ = *place;
            ocean_->dynamic_waves().set_center(place->x, place->y);
        }
        Disturbance here = splash;
        here.x_m = place->x;
        here.z_m = place->y;
        ocean_->dynamic_waves().add_impulse(here);
    }

    void put_boat() {
        const Camera camera = camera_.camera();
        const glm::dvec2 ahead(camera.target_m.x - camera.position_m.x, camera.target_m.z - camera.position_m.z);
        const double heading = std::atan2(ahead.y, ahead.x);
        boat_.emplace(glm::dvec2(camera.position_m.x, camera.position_m.z) +
                          boat_ahead_m * glm::dvec2(std::cos(heading), std::sin(heading)),
                      heading);
        if (settings_.follows_boat) camera_.look_at({boat_->place_m().x, 1, boat_->place_m().y});
        if (boat_model_) return;
        boat_model_.emplace(window_.functions());
        if (!statistics_.sky_is_baking) boat_model_->set_light(baker_.complete());
    }

    void take_boat() {
        window_middle_ = boat_->place_m();
        boat_.reset();
        statistics_.boat_mps.reset();
        if (boat_source_) ocean_->dynamic_waves().remove_source(*boat_source_);
        boat_source_.reset();
    }

    /// Small water is drawn in place of the cascades, whose heights it has not.
    double drawn_height(const SurfaceQuery& query, double x, double z) const {
        if (surface_ != gl::Surface::open) return sample(query.frame().dynamic_waves, x, z).height_m;
        float height_m = 0;
        query.sample({{&x, 1}, {&z, 1}}, {.height_m = {&height_m, 1}});
        return static_cast<double>(height_m);
    }

    void take_caustics() {
        if (!caustics_are_baking_) return;
        renderer_->set_caustics(caustics_.complete());
        caustics_are_baking_ = false;
        has_caustics_ = true;
    }

    /// Small water lies level, or nearly.
    gl::CameraWaterPlane camera_water_plane(const Frame& frame) const {
        if (surface_ != gl::Surface::open) return {};
        return gl::camera_water_plane(SurfaceQuery(frame), camera_.camera().position_m);
    }

    /// Every second frame: while the next two are made.
    void start_caustics(const Frame& frame) {
        const double above_water_m = camera_.camera().position_m.y - camera_water_plane(frame).height_m;
        if (frames_ % 2 == 1 || !gl::shows_caustics(options_.floor, frame.sea.depth_m, above_water_m)) return;
        caustics_.schedule(frame, {.depth_m = gl::caustics_depth_m(options_.floor, frame.sea.depth_m),
                                   .sun = gl::sun_direction(shown_sky_)});
        caustics_are_baking_ = true;
    }

    void draw_frame(double passed_s) {
        const Frame& frame = next_frame(passed_s);
        start_caustics(frame);
        shown_time_s_ = frame.time_s;
        statistics_.cascade_sides_m.clear();
        for (const Cascade& cascade : frame.cascades) statistics_.cascade_sides_m.push_back(cascade.grid.side_m);
        statistics_.significant_wave_height_m = frame.statistics.significant_wave_height_m;
        image_.follow(settings_.camera, unmetered_ev_, passed_s);
        statistics_.ev = image_.ev();

        // A sea that moves never rests: full size is for a frozen one before a camera that stands, and for images.
        const Camera camera = camera_.camera();
        const Drawn now{.position_m = camera.position_m,
                        .target_m = camera.target_m,
                        .vertical_view_rad = camera.vertical_view_rad,
                        .time_s = frame.time_s,
                        .window_width = window_.width(),
                        .window_height = window_.height(),
                        .wireframe = settings_.wireframe,
                        .changes = changes_};
        rests_for_s_ = now == drawn_ ? rests_for_s_ + passed_s : 0;
        const bool rests = settings_.scale_is_automatic && rests_for_s_ >= rest_s;
        const RenderStep full_size{1, settings_.shading.value_or(gl::Shading::high)};
        RenderStep step = full_size;
        if (!settings_.scale_is_automatic)
            step.scale = settings_.fixed_scale;
        else if (!rests && !takes_image_)
            step = scale_by_time_.step();
        sea_was_drawn_ = now != drawn_ || (rests && drawn_step_ != step) || takes_image_ ||
                         step.scale > drawn_step_.scale || step.shading > drawn_step_.shading;
        if (sea_was_drawn_) {
            // A renderer's first sky is one that is ready.
            if (step.shading != statistics_.shading && !statistics_.sky_is_baking) choose_shading(step.shading);
            draw_sea(frame, camera, step.scale);
            drawn_ = now;
            drawn_.changes = changes_;  // a mesh may just have been chosen
            drawn_step_ = {step.scale, statistics_.shading};
            // The size that a resting view or an image asks for says nothing of the next frame's.
            sea_was_drawn_ = !rests && !takes_image_;
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
                                                   .depth = ClipDepth::minus_one_to_one});
        statistics_.select_us = select.milliseconds() * 1000;
        statistics_.patches = list.instances.size();
        renderer_->upload(frame);
        const float exposure = gl::exposure_of_ev(image_.ev(), luminance_of_unit_);
        const gl::DrawStatistics& drawn =
            renderer_->draw({.eyes = {&eye, 1},
                             .viewer_m = camera.position_m,
                             .list = &list,
                             .lod_scale = selection_->options().lod_scale,
                             .mode = settings_.wireframe ? gl::DrawMode::wireframe : gl::DrawMode::shaded,
                             .exposure = exposure,
                             .weighs_samples = true,
                             .camera_water_plane = camera_water_plane(frame),
                             .application_scene = draw_boat(eye, exposure)});
        statistics_.upload_ms = drawn.upload_ms - drawn.upload_driver_ms;
        statistics_.draw_ms = drawn.draw_ms - drawn.draw_driver_ms;
        statistics_.draw_calls = drawn.sea_calls + drawn.sky_calls;
        statistics_.triangles = drawn.triangles;
        if (!settings_.wireframe) image_.end(luminance_of_unit_);
    }

    /// Before the sea, which mirrors it where a GPU draws.
    std::optional<gl::ApplicationScene> draw_boat(const gl::Eye& eye, float exposure) {
        if (!boat_ || settings_.wireframe) return {};
        const glm::dmat4 pose = boat_->world_from_boat();
        boat_model_->draw(eye, pose, exposure);
        if (is_software_ && !takes_image_) return {};
        return boat_model_->image(eye, pose);
    }

    /// Lines are no light: they go to the screen as they are.
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

    /// What was drawn last, into the window.
    void show_sea() {
        const int width = window_.width(), height = window_.height();
        if (settings_.wireframe)
            wireframe_->show(width, height, width, height);
        else
            image_.show(settings_.camera, width, height);
    }

    /// Without the panel: it is drawn afterwards.
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
    std::optional<gl::Shading> followed_shading_;  ///< of the settings, as scale_by_time_ knows it
    std::shared_ptr<StageTimes> stage_times_ = std::make_shared<StageTimes>();
    std::optional<Ocean> ocean_;
    SeaState shown_sea_;
    gl::SkyBaker baker_;
    gl::SkyOptions shown_sky_;
    gl::CausticsBaker caustics_;
    bool caustics_are_baking_ = false, has_caustics_ = false;
    ViewCamera camera_;
    std::string quality_;
    gl::Surface surface_ = gl::Surface::open;
    std::optional<Selection> selection_;
    std::array<std::unique_ptr<gl::SeaRenderer>, gl::shading_names.size()>
        renderers_;                        ///< by shading, once it is drawn
    gl::SeaRenderer* renderer_ = nullptr;  ///< of statistics_.shading
    std::optional<gl::RenderTarget> wireframe_;
    float luminance_of_unit_ = 1, unmetered_ev_ = 15;  ///< of the shown sky
    Drawn drawn_;
    RenderStep drawn_step_{0, gl::Shading::headset};
    double rests_for_s_ = 0;
    bool sea_was_drawn_ = false;  ///< in the size that frame times decide
    unsigned long long changes_ = 0;
    ViewStatistics statistics_;
    bool shows_panel_ = true, takes_image_ = false;
    std::optional<glm::dvec2> clicked_;  ///< a pixel of the window, from its upper left corner
    glm::dvec2 window_middle_{};         ///< of the dynamic waves, while there is no boat
    Helm helm_;
    bool wants_boat_ = false;
    std::optional<SteeredBoat> boat_;
    std::optional<std::uint32_t> boat_source_;  ///< of the ocean
    std::optional<gl::Boat> boat_model_;
    double time_s_ = 0, shown_time_s_ = 0;
    std::uint64_t frames_ = 0;
};

}  // namespace

ViewResult show_sea(const ViewOptions& options) { return Viewer(options).run(); }

}  // namespace pelagic::viewer
