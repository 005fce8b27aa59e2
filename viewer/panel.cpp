#include "pelagic/viewer/panel.hpp"

#include <imgui.h>

#include <algorithm>
#include <cstdio>
#include <numbers>

#include "pelagic/gl/sky/light_presets.hpp"
#include "pelagic/message/number_text.hpp"
#include "pelagic/quadtree/quadtree_options.hpp"
#include "pelagic/viewer/sliders.hpp"

namespace pelagic::viewer {
namespace {

constexpr float panel_width = 360;
constexpr float to_deg = 180 / std::numbers::pi_v<float>;

bool slide(const Slider& slider, double& value) {
    return ImGui::SliderScalar(slider.label, ImGuiDataType_Double, &value, &slider.min, &slider.max, slider.format);
}

bool slide(const Slider& slider, float& value) {
    return ImGui::SliderFloat(slider.label, &value, static_cast<float>(slider.min), static_cast<float>(slider.max),
                              slider.format);
}

/// Shows a slider in degrees. Returns true if the user has changed the angle.
bool slide_angle(const Slider& slider, auto& radians) {
    float degrees = static_cast<float>(radians) * to_deg;
    if (!slide(slider, degrees)) return false;
    radians = static_cast<std::remove_reference_t<decltype(radians)>>(degrees / to_deg);
    return true;
}

std::string_view label_of(gl::Surface surface) { return name_of(surface); }
std::string_view label_of(const auto& preset) { return preset.name; }

/// Shows a list. Calls take() with the item that the user chooses.
void choose(const char* label, std::string_view shown, const auto& items, const auto& take) {
    if (!ImGui::BeginCombo(label, std::string(shown).c_str())) return;
    for (const auto& item : items)
        if (ImGui::Selectable(std::string(label_of(item)).c_str(), label_of(item) == shown)) take(item);
    ImGui::EndCombo();
}

void choose_preset(SeaState& sea) {
    choose("sea state", "choose ...", sea_presets(), [&](const SeaPreset& preset) {
        const SeaState before = sea;
        sea = preset.sea;
        if (before.waves != sea.waves && (is_of_fixed_model(before) || is_of_fixed_model(sea))) return;
        sea.resolution = before.resolution;  // the renderer keeps its textures
        sea.cascades = before.cascades;
        sea.patch_size_m = before.patch_size_m;
        if (!check(sea).empty()) sea = preset.sea;
    });
}

/// Shows the wave parameters that do not follow from the wind.
void choose_waves(SeaState& sea) {
    if (sea.waves == WaveModel::analytic) slide(sliders::strength, sea.wave_strength);
    if (sea.waves == WaveModel::pond) slide(sliders::drag, sea.wave_drag);
}

/// Shows the number of cascades. The user can change it unless is_limited_to_one_cascade() is true: the
/// patch size was given, or the model supports no other number.
void choose_cascades(SeaState& sea, const std::vector<double>& sides_m) {
    int cascades = cascades_of(sea);
    if (!is_limited_to_one_cascade(sea) &&
        ImGui::SliderInt(sliders::cascades.label, &cascades, static_cast<int>(sliders::cascades.min),
                         static_cast<int>(sliders::cascades.max)))
        sea.cascades = cascades;
    std::string sides;
    for (const double side : sides_m) sides += (sides.empty() ? "" : ", ") + number_text(side);
    ImGui::Text("cascades of %s m", sides.c_str());
}

/// Shows the light presets. A preset sets the whole sky, the exposure bias and the light through
/// crests at once.
void choose_light(ViewSettings& settings) {
    const std::string shown = settings.light.empty() ? "choose ..." : settings.light;
    choose("light", shown, gl::light_presets(), [&](const gl::LightPreset& preset) {
        settings.light = preset.name;
        settings.sky = preset.sky;
        settings.camera.bias_stops = preset.bias_stops;
        settings.crest_glow = preset.crest_glow;
    });
}

void choose_exposure(gl::CameraSettings& camera, float ev) {
    bool automatic = !camera.fixed_ev;
    if (ImGui::Checkbox("automatic exposure", &automatic))
        camera.fixed_ev = automatic ? std::nullopt : std::optional<float>(ev);
    if (camera.fixed_ev) {
        ImGui::SliderFloat("EV", &*camera.fixed_ev, gl::min_ev, gl::max_ev, "%.1f");
    } else {
        ImGui::SameLine();
        ImGui::Text("EV %.1f", static_cast<double>(ev));
        slide(sliders::brighter, camera.bias_stops);
    }
    ImGui::SliderFloat("bloom", &camera.bloom, 0, 0.5f, "%.2f");
}

void choose_scale(ViewSettings& settings, const ViewStatistics& statistics) {
    ImGui::Checkbox("size by frame time", &settings.scale_is_automatic);
    ImGui::SameLine();
    ImGui::Text("%dx%d", statistics.drawn_width, statistics.drawn_height);
    if (!settings.scale_is_automatic) ImGui::SliderFloat("size", &settings.fixed_scale, 0.25f, 1, "%.2f");
}

void choose_shading(std::optional<gl::Shading>& shading, gl::Shading drawn) {
    const std::string by_time = "auto: " + std::string(name_of(drawn));
    if (!ImGui::BeginCombo("shading", shading ? name_of(*shading).data() : by_time.c_str())) return;
    if (ImGui::Selectable("auto", !shading)) shading.reset();
    for (const gl::Shading each : values_of<gl::Shading>())
        if (ImGui::Selectable(name_of(each).data(), shading == each)) shading = each;
    ImGui::EndCombo();
}

void show_times(const ViewStatistics& statistics, const std::vector<StageTimes::Row>& rows) {
    ImGui::Text("%.1f ms a frame, %.2f million triangles", statistics.frame_ms,
                static_cast<double>(statistics.drawn.triangles) / 1e6);
    ImGui::Text("%zu patches in %d draws, selected in %.0f us", statistics.patches,
                statistics.drawn.sea_calls + statistics.drawn.sky_calls, statistics.drawn.select_ms * 1000);
    ImGui::Text("CPU: upload %.2f ms, draw %.2f ms", statistics.drawn.upload_ms - statistics.drawn.upload_driver_ms,
                statistics.drawn.draw_ms - statistics.drawn.draw_driver_ms);
    for (const StageTimes::Row& row : rows) {
        const float largest = *std::max_element(row.ms.begin(), row.ms.end());
        char text[80];
        std::snprintf(text, sizeof text, "%s %.3f ms", row.name.c_str(), static_cast<double>(row.ms.back()));
        ImGui::PlotLines(("##" + row.name).c_str(), row.ms.data(), static_cast<int>(row.ms.size()), 0, text, 0,
                         std::max(largest, 0.01f) * 1.2f, ImVec2(panel_width - 16, 24));
    }
}

}  // namespace

void show_panel(ViewSettings& settings, ViewCamera& camera, const ViewStatistics& statistics,
                const std::vector<StageTimes::Row>& stage_times) {
    ImGui::SetNextWindowPos(ImVec2(10, 10), ImGuiCond_FirstUseEver);
    ImGui::SetNextWindowSize(ImVec2(panel_width, 0), ImGuiCond_Always);
    ImGui::Begin("Pelagic");
    slide(sliders::wind, settings.sea.wind_speed_mps);
    slide_angle(sliders::wind_direction, settings.sea.wind_direction_rad);
    slide(sliders::choppiness, settings.sea.choppiness);
    choose_waves(settings.sea);
    choose_preset(settings.sea);
    choose_cascades(settings.sea, statistics.cascade_sides_m);
    slide({"changes take", "", 0, 60, "%.0f s"}, settings.change_over_s);
    ImGui::Text("waves of %.2f m%s", statistics.significant_wave_height_m,
                statistics.sea_is_baking || statistics.sea_is_changing ? ", changing" : "");
    ImGui::Separator();
    choose_light(settings);
    slide_angle(sliders::sun_direction, settings.sky.sun_azimuth_rad);
    slide_angle(sliders::sun_height, settings.sky.sun_elevation_rad);
    slide(sliders::clouds, settings.sky.cloud_cover);
    if (statistics.sky_is_baking) ImGui::Text("baking the sky ...");
    choose_exposure(settings.camera, statistics.ev);
    ImGui::Separator();
    choose("quality", settings.quality, quadtree_presets(),
           [&](const QuadtreePreset& preset) { settings.quality = preset.name; });
    choose_scale(settings, statistics);
    choose_shading(settings.shading, statistics.shading);
    choose("surface", name_of(settings.surface), values_of<gl::Surface>(),
           [&](gl::Surface surface) { settings.surface = surface; });
    ImGui::Checkbox("wireframe", &settings.wireframe);
    ImGui::SameLine();
    ImGui::Checkbox("freeze", &settings.frozen);
    ImGui::SameLine();
    bool flies = camera.mode() == ViewCamera::Mode::fly;
    if (ImGui::Checkbox("fly", &flies)) camera.set_mode(flies ? ViewCamera::Mode::fly : ViewCamera::Mode::orbit);
    if (statistics.boat_mps) {
        ImGui::Text("boat: %.1f m/s", *statistics.boat_mps);
        ImGui::SameLine();
        ImGui::Checkbox("camera follows it", &settings.follows_boat);
    }
    ImGui::Separator();
    show_times(statistics, stage_times);
    ImGui::TextDisabled("camera: drag, wheel, WASD, R, F");
    ImGui::TextDisabled("click: a splash; B: a boat, arrows steer it");
    ImGui::TextDisabled("H hides this, P saves an image, Esc ends");
    ImGui::End();
}

}  // namespace pelagic::viewer
