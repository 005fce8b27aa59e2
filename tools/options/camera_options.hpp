// The options --camera, --target and --fov.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/quadtree/camera.hpp"

namespace pelagic::tools {

/// Declares and checks the camera options.
class CameraFlags {
   public:
    void add_to(CLI::App& app);
    /// \param sea_level_m  height above which the default camera is placed
    /// \throws InputError  if a value is invalid
    Camera resolve(double sea_level_m = 0) const;
    bool has_place() const { return camera_.has_value(); }  ///< true if --camera was given

   private:
    std::optional<std::string> camera_, target_, fov_;
};

}  // namespace pelagic::tools
