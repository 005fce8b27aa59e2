// The settings panel of the window, with frame statistics and stage times.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pelagic/gl/exposure.hpp"
#include "pelagic/gl/sky/sky_baker.hpp"
#include "pelagic/gl/water/sea_renderer.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/viewer/stage_times.hpp"
#include "pelagic/viewer/view_camera.hpp"

namespace pelagic::viewer {

/// Settings that the user can change.
struct ViewSettings {
    SeaState sea;
    double change_over_s = 4;  ///< duration of a transition to another sea state; 0: immediate
    std::string light;         ///< name of the chosen light preset, or empty
    gl::SkyOptions sky;
    gl::WaterOptics water;
    /// If empty, frame times determine the shading together with the scale. The shading is then
    /// high if the scale is fixed or the view is static.
    std::optional<gl::Shading> shading;
    gl::CameraSettings camera;
    float crest_glow = 1;  ///< gl::DrawInput::crest_glow
    gl::Surface surface = gl::Surface::open;
    std::optional<gl::FlowMap> flow;  ///< flow of a river; if empty, a winding channel
    std::string quality = "high";
    double size_m = 2048;
    bool scale_is_automatic = true;
    float fixed_scale = 1;  ///< size of the drawn image relative to the window's; [0.25, 1]
    bool wireframe = false;
    bool frozen = false;
    bool follows_boat = true;  ///< the camera moves with the boat
};

/// Statistics of the last frame, for the panel.
struct ViewStatistics {
    double frame_ms = 0;
    gl::DrawStatistics drawn;               ///< of the last drawn image
    int drawn_width = 0, drawn_height = 0;  ///< size of the drawn image before enlargement, pixels
    gl::Shading shading = gl::Shading::high;
    float ev = 0;  ///< exposure value
    std::size_t patches = 0;
    double significant_wave_height_m = 0;
    std::vector<double> cascade_sides_m;
    std::optional<double> boat_mps;  ///< speed of the boat, if there is a boat
    bool sea_is_baking = false, sea_is_changing = false, sky_is_baking = false;
};

/// Draws the widgets of one Dear ImGui frame, and applies the user's changes to the settings and to
/// the camera's mode.
void show_panel(ViewSettings& settings, ViewCamera& camera, const ViewStatistics& statistics,
                const std::vector<StageTimes::Row>& stage_times);

}  // namespace pelagic::viewer
