#include "pelagic/viewer/viewer.hpp"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "pelagic/gl/stopwatch.hpp"
#include "pelagic/viewer/panel_renderer.hpp"
#include "pelagic/viewer/view_image.hpp"
#include "pelagic/viewer/view_scene.hpp"
#include "pelagic/viewer/window.hpp"

namespace pelagic::viewer {
namespace {

constexpr double radians_a_pixel = 0.004;
constexpr double slowest_mps = 8;  // minimum flying speed; the speed grows with height
/// Limits of movement and duration for a click, which makes a splash instead of rotating the
/// camera.
constexpr float max_pixels_of_a_click = 4;
constexpr double max_s_of_a_click = 0.4;

/// The user's keys and pointer, and the panel, by Dear ImGui.
class Controls {
   public:
    explicit Controls(Window& window) : window_(window), renderer_(window.functions(), Window::get_proc_address()) {
        ImGui::GetIO().IniFilename = nullptr;  // writes no file to the working directory
        ImGui::StyleColorsDark();
        ImGui::GetStyle().Colors[ImGuiCol_WindowBg].w = 0.82f;
        ImGui_ImplGlfw_InitForOther(window.handle(), true);
    }

    /// Applies the events of the last Window::poll(). Moves the camera.
    void take(UserInput& input, ViewCamera& camera, double passed_s) {
        ImGui_ImplGlfw_NewFrame();
        ImGui::NewFrame();
        const ImGuiIO& io = ImGui::GetIO();
        input.window = {io.DisplaySize.x, io.DisplaySize.y};
        if (!io.WantTextInput) {
            for (const int key : window_.pressed_keys()) {
                if (key == GLFW_KEY_ESCAPE) window_.close();
                if (key == GLFW_KEY_H) shows_panel_ = !shows_panel_;
                if (key == GLFW_KEY_P) takes_image_ = true;
                if (key == GLFW_KEY_B) input.boat_is_requested = !input.boat_is_requested;
            }
            const auto held = [](int key) { return ImGui::IsKeyDown(key) ? 1.0 : 0.0; };
            const double metres = passed_s * std::max(slowest_mps, std::abs(camera.camera().position_m.y));
            camera.move(metres * glm::dvec3(held(GLFW_KEY_D) - held(GLFW_KEY_A), held(GLFW_KEY_R) - held(GLFW_KEY_F),
                                            held(GLFW_KEY_W) - held(GLFW_KEY_S)));
            input.helm = {held(GLFW_KEY_UP) - held(GLFW_KEY_DOWN), held(GLFW_KEY_RIGHT) - held(GLFW_KEY_LEFT)};
        }
        if (io.WantCaptureMouse) return;
        if (ImGui::IsMouseReleased(ImGuiMouseButton_Left) &&
            io.MouseDragMaxDistanceSqr[0] <= max_pixels_of_a_click * max_pixels_of_a_click &&
            static_cast<double>(io.MouseDownDurationPrev[0]) <= max_s_of_a_click)
            input.clicked = glm::dvec2(io.MousePos.x, io.MousePos.y);
        // In the frame of a press, io.MouseDelta would include the movement before the press.
        if (ImGui::IsMouseDown(ImGuiMouseButton_Left)) camera.turn(radians_a_pixel * window_.dragged_px());
        if (io.MouseWheel != 0) camera.zoom(std::pow(0.9, static_cast<double>(io.MouseWheel)));
    }

    /// Draws the panel into the window, unless the user has hidden it. Called after take().
    void draw_panel(ViewSettings& settings, ViewCamera& camera, const ViewStatistics& statistics,
                    const StageTimes& stage_times) {
        if (shows_panel_) show_panel(settings, camera, statistics, stage_times.rows());
        ImGui::Render();
        renderer_.draw(*ImGui::GetDrawData());
    }

    /// Returns whether the user has asked for an image since the last call.
    bool takes_image() { return std::exchange(takes_image_, false); }

   private:
    static void destroy(ImGuiContext* context) {
        if (ImGui::GetIO().BackendPlatformUserData) ImGui_ImplGlfw_Shutdown();
        ImGui::DestroyContext(context);
    }

    Window& window_;
    std::unique_ptr<ImGuiContext, decltype(&destroy)> context_{ImGui::CreateContext(), destroy};
    PanelRenderer renderer_;
    bool shows_panel_ = true, takes_image_ = false;
};

class Viewer {
   public:
    explicit Viewer(const ViewOptions& options)
        : options_(options),
          settings_(options.settings),
          camera_(options.camera),
          window_(options.width, options.height, "Pelagic"),
          controls_(window_),
          scene_(options, settings_, camera_, statistics_),
          image_(window_.functions(), options, settings_, statistics_) {}

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
            controls_.take(input_, camera_, passed_s);
            if (!scene_.follow_settings(time_s_)) {
                image_.release_ocean();
                scene_.create_ocean(time_s_);
            }
            image_.follow_settings(scene_.ocean());
            if (window_.size().x > 0 && window_.size().y > 0) draw_frame(passed_s);
            window_.swap();
            ++frames_;
            image_.adapt_to(since_start.milliseconds() - now_s * 1000);
        }
        return {.settings = settings_,
                .camera = camera_.camera(),
                .time_s = shown_time_s_,
                .width = window_.size().x,
                .height = window_.size().y,
                .frames = frames_,
                .renderer = reinterpret_cast<const char*>(window_.functions().GetString(GL_RENDERER))};
    }

   private:
    void draw_frame(double passed_s) {
        const glm::ivec2 size = window_.size();
        const Frame& frame = scene_.complete(time_s_);
        image_.upload(frame);
        scene_.schedule(frame, time_s_, input_);
        shown_time_s_ = frame.time_s;
        const bool is_saved = controls_.takes_image();
        image_.draw(frame, scene_, camera_.camera(), size, is_saved, passed_s);
        if (is_saved && options_.save_image) options_.save_image(window_.read_pixels(), size.x, size.y);
        controls_.draw_panel(settings_, camera_, statistics_, scene_.stage_times());
    }

    const ViewOptions& options_;
    ViewSettings settings_;
    ViewStatistics statistics_;
    ViewCamera camera_;
    UserInput input_;
    Window window_;
    Controls controls_;
    ViewScene scene_;
    ViewImage image_;  ///< reads frames of the scene
    double time_s_ = 0, shown_time_s_ = 0;
    std::uint64_t frames_ = 0;
};

}  // namespace

ViewResult show_sea(const ViewOptions& options) { return Viewer(options).run(); }

}  // namespace pelagic::viewer
