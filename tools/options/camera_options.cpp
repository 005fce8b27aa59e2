#include "pelagic/tools/options/camera_options.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

constexpr double furthest_camera_m = 1e7;
constexpr glm::dvec3 default_position_m{0, 8, 0}, default_target_m{60, 0, 60};
const glm::dvec3 ahead_m{60, -8, 60};  // slightly down
constexpr double default_fov_deg = 60;

glm::dvec3 point(const std::string& option, const std::string& text) {
    const auto reject = [&] { return bad_value(option, text, "X,Y,Z in metres, each in [-1e7, 1e7]"); };
    const std::vector<std::string> parts = split_at_commas(text);
    if (parts.size() != 3) throw reject();
    glm::dvec3 all;
    for (int axis = 0; axis < 3; ++axis) {
        const auto number = parse_number(parts[static_cast<std::size_t>(axis)]);
        if (!number || std::abs(*number) > furthest_camera_m) throw reject();
        all[axis] = *number;
    }
    return all;
}

/// Returns "X,Z" at height 0.
glm::dvec3 place_with_eye_height(const std::string& text) {
    const std::vector<std::string> parts = split_at_commas(text);
    const auto x = parse_number(parts[0]), z = parse_number(parts.size() == 2 ? parts[1] : "");
    if (!x || !z || std::abs(*x) > furthest_camera_m || std::abs(*z) > furthest_camera_m)
        throw bad_value("--camera", text, "X,Z in metres with --eye-height, each in [-1e7, 1e7]");
    return {*x, 0, *z};
}

}  // namespace

void CameraFlags::add_to(CLI::App& app) {
    const auto text = [](glm::dvec3 p) { return number_text(p.x) + "," + number_text(p.y) + "," + number_text(p.z); };
    app.add_option("--camera", camera_, "position in metres, y up (default: " + text(default_position_m) + ")")
        ->type_name("X,Y,Z")
        ->group(help_group::view);
    app.add_option("--target", target_, "point to look at, in metres (default: " + text(default_target_m) + ")")
        ->type_name("X,Y,Z")
        ->group(help_group::view);
    app.add_option("--fov", fov_,
                   "vertical field of view; degrees in [1, 160] (default: " + number_text(default_fov_deg) + ")")
        ->type_name("DEGREES")
        ->group(help_group::view);
}

Camera CameraFlags::resolve(double sea_level_m, const CameraMotion& motion) const {
    const glm::dvec3 level(0, sea_level_m, 0);
    Camera camera{default_position_m + level, default_target_m + level, glm::radians(default_fov_deg)};
    if (motion.path) {
        if (camera_ || target_)
            throw InputError(std::string("--path cannot be combined with ") + (camera_ ? "--camera" : "--target"));
        camera.position_m = motion.path->keys.front().position_m;
        camera.target_m = motion.path->keys.front().target_m;
    } else if (camera_) {
        camera.position_m = motion.eye_height_m ? place_with_eye_height(*camera_) : point("--camera", *camera_);
    }
    if (motion.eye_height_m) camera.position_m.y = sea_level_m + *motion.eye_height_m;
    if (target_)
        camera.target_m = point("--target", *target_);
    else if ((camera_ || motion.eye_height_m) && !motion.path)
        camera.target_m = camera.position_m + ahead_m;
    if (!motion.path && glm::length(camera.target_m - camera.position_m) < 1e-6)
        throw bad_value("--target", target_.value_or("the default"), "another place than --camera");
    if (fov_) camera.vertical_view_rad = glm::radians(number_in("--fov", *fov_, 1, 160, "[1, 160]"));
    return camera;
}

}  // namespace pelagic::tools
