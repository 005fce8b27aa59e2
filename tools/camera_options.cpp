#include "pelagic/tools/camera_options.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtc/matrix_transform.hpp>

#include "pelagic/tools/errors.hpp"
#include "pelagic/tools/option_text.hpp"

namespace pelagic::tools {
namespace {

constexpr double furthest_m = 1e7;

glm::dvec3 point(const std::string& option, const std::string& text) {
    const auto refuse = [&] { return bad_value(option, text, "X,Y,Z in metres, each in [-1e7, 1e7]"); };
    const std::vector<std::string> parts = split_at_commas(text);
    if (parts.size() != 3) throw refuse();
    glm::dvec3 all;
    for (int axis = 0; axis < 3; ++axis) {
        const auto number = parse_number(parts[static_cast<std::size_t>(axis)]);
        if (!number || std::abs(*number) > furthest_m) throw refuse();
        all[axis] = *number;
    }
    return all;
}

}  // namespace

glm::dvec3 Camera::forward() const { return glm::normalize(target_m - eye_m); }

glm::dvec3 Camera::right() const {
    const glm::dvec3 level = glm::cross(forward(), glm::dvec3(0, 1, 0));
    // Straight up or down.
    if (glm::length(level) < 1e-9) return {0, 0, forward().y < 0 ? 1 : -1};
    return glm::normalize(level);
}

glm::dmat4 Camera::view_from_world() const {
    return glm::lookAtRH(eye_m, eye_m + forward(), glm::cross(right(), forward()));
}

Camera Camera::moved_right(double metres) const {
    Camera moved = *this;
    moved.eye_m += metres * right();
    moved.target_m += metres * right();
    return moved;
}

void CameraFlags::add_to(CLI::App& app) {
    const Camera c;
    const auto text = [](glm::dvec3 p) { return number_text(p.x) + "," + number_text(p.y) + "," + number_text(p.z); };
    app.add_option("--camera", camera_, "where it is seen from, X,Y,Z in metres, y up [" + text(c.eye_m) + "]")
        ->type_name("X,Y,Z");
    app.add_option("--target", target_, "what is looked at, X,Y,Z in metres [" + text(c.target_m) + "]")
        ->type_name("X,Y,Z");
    app.add_option("--fov", fov_, "vertical field of view, degrees, [1, 160] [" + number_text(c.fov_deg) + "]")
        ->type_name("DEG");
}

Camera CameraFlags::resolve() const {
    Camera camera;
    if (camera_) camera.eye_m = point("--camera", *camera_);
    if (target_)
        camera.target_m = point("--target", *target_);
    else if (camera_)
        camera.target_m = camera.eye_m + glm::dvec3(60, -8, 60);  // ahead and a little down, wherever the camera is
    if (glm::length(camera.target_m - camera.eye_m) < 1e-6)
        throw bad_value("--target", target_.value_or("the default"), "another place than --camera");
    if (fov_) {
        const auto degrees = parse_number(*fov_);
        if (!degrees || *degrees < 1 || *degrees > 160) throw bad_value("--fov", *fov_, "[1, 160]");
        camera.fov_deg = *degrees;
    }
    return camera;
}

}  // namespace pelagic::tools
