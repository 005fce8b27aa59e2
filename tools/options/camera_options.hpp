// The options --camera, --target and --fov.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/quadtree/camera.hpp"
#include "pelagic/tools/options/camera_path.hpp"

namespace pelagic::tools {

/// Declares and checks the camera options.
class CameraFlags {
   public:
    void add_to(CLI::App& app);
    /// Returns the camera; with a path, that of its first key. With an eye height it is placed that high
    /// above the sea level, and without --target it looks ahead and slightly down.
    /// \param sea_level_m  height above which the default camera is placed
    /// \throws InputError  if a value is invalid, or contradicts the motion
    Camera resolve(double sea_level_m = 0, const CameraMotion& motion = {}) const;
    bool has_place() const { return camera_.has_value(); }    ///< true if --camera was given
    bool has_target() const { return target_.has_value(); }  ///< true if --target was given

   private:
    std::optional<std::string> camera_, target_, fov_;
};

}  // namespace pelagic::tools
