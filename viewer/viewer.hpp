// The viewer of `pelagic view`: the sea in a window, with a settings panel.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "pelagic/gl/views.hpp"
#include "pelagic/gl/water/sea_floor.hpp"
#include "pelagic/sim/forecast.hpp"
#include "pelagic/sim/water_frame.hpp"
#include "pelagic/viewer/panel.hpp"

namespace pelagic::viewer {

struct ViewOptions {
    ViewSettings settings;
    Camera camera;
    gl::SeaFloor floor = {};
    /// If set, the sea floor affects the waves, unless the sea state does not support a shore.
    std::optional<ShoreOptions> shore = {};
    /// Sea level and current; excluded by a shore.
    WaterFrame water_frame = {};
    /// Whether spray is drawn. If unset, it is drawn except with Shading::headset.
    std::optional<bool> spray = {};
    /// Transitions of settings.sea, until the user changes the sea state.
    std::vector<SeaChange> changes = {};
    int width = 1280, height = 720;
    int threads = 0;  ///< argument of make_default_executor()

    /// Called with each image that the user saves (key P): RGBA8, top row first.
    std::function<void(std::span<const std::uint8_t> pixels, int width, int height)> save_image = {};
};

/// State of the viewer when the window was closed.
struct ViewResult {
    ViewSettings settings;
    Camera camera;
    double time_s = 0;          ///< time of the frame that was drawn last
    int width = 0, height = 0;  ///< size of the window, pixels
    std::uint64_t frames = 0;
    std::string renderer;  ///< GL_RENDERER of the driver
};
/// Shows the sea until the user closes the window.
/// \throws gl::GlError if there is no display or no driver
/// \throws std::invalid_argument if an option is out of range
ViewResult show_sea(const ViewOptions& options);

}  // namespace pelagic::viewer
