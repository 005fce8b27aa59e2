// The panel of the window: what can be changed while one looks, and how long it takes.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "pelagic/gl/exposure.hpp"
#include "pelagic/gl/sky/sky_baker.hpp"
#include "pelagic/gl/water/shading.hpp"
#include "pelagic/gl/water/small_water.hpp"
#include "pelagic/gl/water/water_optics.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/viewer/stage_times.hpp"
#include "pelagic/viewer/view_camera.hpp"

namespace pelagic::viewer {

/// What the user has chosen.
struct ViewSettings {
    SeaState sea;
    double change_over_s = 4;  ///< how long the sea takes to turn into what is chosen; 0: at once
    std::string light;         ///< name of the preset that the sky was chosen by, or empty
    gl::SkyOptions sky;
    gl::WaterOptics water;
    std::optional<gl::Shading>
        shading;  ///< none: by the frame time, as the scale; high where that is fixed or nothing moves
    gl::CameraSettings camera;
    gl::Surface surface = gl::Surface::open;
    std::optional<gl::FlowMap> flow;  ///< of a river; none: a winding channel
    std::string quality = "high";
    double size_m = 2048;
    bool scale_is_automatic = true;
    float fixed_scale = 1;  ///< of the drawn image's width and height over the window's; [0.25, 1]
    bool wireframe = false;
    bool frozen = false;
    bool follows_boat = true;  ///< the camera goes along with the boat
};

/// What the panel shows of the last frame.
struct ViewStatistics {
    double frame_ms = 0;
    double select_us = 0, upload_ms = 0, draw_ms = 0;
    int draw_calls = 0;
    int drawn_width = 0, drawn_height = 0;  ///< pixels, before they are enlarged to the window
    gl::Shading shading = gl::Shading::high;
    float ev = 0;  ///< the exposure
    std::uint64_t triangles = 0;
    std::size_t patches = 0;
    double significant_wave_height_m = 0;
    std::vector<double> cascade_sides_m;
    std::optional<double> boat_mps;  ///< its speed, if there is one
    bool sea_is_baking = false, sea_is_changing = false, sky_is_baking = false;
};

/// Draws the widgets of one Dear ImGui frame and lets them change the settings and the camera's mode.
void show_panel(ViewSettings& settings, ViewCamera& camera, const ViewStatistics& statistics,
                const std::vector<StageTimes::Row>& stage_times);

}  // namespace pelagic::viewer
