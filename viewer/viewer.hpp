// `pelagic view`: the sea in a window, with a panel to change it.
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
#include "pelagic/viewer/panel.hpp"

namespace pelagic::viewer {

struct ViewOptions {
    ViewSettings settings;
    Camera camera;
    gl::SeaFloor floor = {};
    /// Waves feel the floor; of the seas that the user chooses those do that can have a shore.
    std::optional<ShoreOptions> shore = {};
    std::vector<SeaChange> changes = {};  ///< of the settings' sea, until the user changes it
    int width = 1280, height = 720;
    int threads = 0;  ///< as make_default_executor() takes them

    /// Called with each image that the user takes (key P): RGBA8, the upper row first.
    std::function<void(std::span<const std::uint8_t> pixels, int width, int height)> save_image = {};
};

/// Shows the sea until the window is closed. Returns what the user left it at.
/// Throws gl::GlError if there is no display or no driver; std::invalid_argument for options out of range.
struct ViewResult {
    ViewSettings settings;
    Camera camera;
    double time_s = 0;          ///< of the sea that was drawn last
    int width = 0, height = 0;  ///< of the window, pixels
    std::uint64_t frames = 0;
    std::string renderer;  ///< the driver's name for itself
};
ViewResult show_sea(const ViewOptions& options);

}  // namespace pelagic::viewer
