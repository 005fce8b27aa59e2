// --camera, --target and --fov: where an image or a selection is seen from.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/quadtree/camera.hpp"

namespace pelagic::tools {

/// Declares and checks the three options.
class CameraFlags {
   public:
    void add_to(CLI::App& app);
    Camera resolve() const;                                 ///< throws InputError
    bool has_place() const { return camera_.has_value(); }  ///< --camera was given

   private:
    std::optional<std::string> camera_, target_, fov_;
};

}  // namespace pelagic::tools
