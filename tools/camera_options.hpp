// --camera, --target and --fov: where a picture or a selection is seen from.
#pragma once

#include <CLI/App.hpp>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

namespace pelagic::tools {

struct Camera {
    glm::dvec3 eye_m{0, 8, 0};
    glm::dvec3 target_m{60, 0, 60};
    double fov_deg = 60;  ///< vertical

    glm::dvec3 forward() const;
    glm::dvec3 right() const;
    /// World to camera: -z is forward, y up. A camera that looks straight up or down has +x at the top of its picture.
    glm::dmat4 view_from_world() const;
    /// The same camera, `metres` to the right.
    Camera moved_right(double metres) const;
};

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
