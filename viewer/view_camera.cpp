#include "pelagic/viewer/view_camera.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace pelagic::viewer {
namespace {

constexpr double steepest_rad = 1.5;  // less than pi / 2, where the horizon is undefined
constexpr double nearest_m = 1, furthest_m = 3000;
constexpr double highest_m = 5000;

}  // namespace

ViewCamera::ViewCamera(const Camera& start) : eye_(start.position_m), vertical_view_rad_(start.vertical_view_rad) {
    look_at(start.target_m);
}

void ViewCamera::look_at(glm::dvec3 place_m) {
    const glm::dvec3 to_target = place_m - eye_;
    distance_ = std::clamp(glm::length(to_target), nearest_m, furthest_m);
    heading_ = std::atan2(to_target.z, to_target.x);
    pitch_ = std::clamp(std::asin(to_target.y / glm::length(to_target)), -steepest_rad, steepest_rad);
}

glm::dvec3 ViewCamera::ahead() const {
    return {std::cos(pitch_) * std::cos(heading_), std::sin(pitch_), std::cos(pitch_) * std::sin(heading_)};
}

void ViewCamera::turn(glm::dvec2 radians) {
    const glm::dvec3 target = eye_ + distance_ * ahead();
    heading_ += radians.x;
    pitch_ = std::clamp(pitch_ - radians.y, -steepest_rad, steepest_rad);
    if (mode_ == Mode::orbit) eye_ = target - distance_ * ahead();
}

void ViewCamera::zoom(double factor) {
    const glm::dvec3 target = eye_ + distance_ * ahead();
    if (mode_ == Mode::fly) {
        move({0, 0, (1 - factor) * 20});
        return;
    }
    distance_ = std::clamp(distance_ * factor, nearest_m, furthest_m);
    eye_ = target - distance_ * ahead();
}

void ViewCamera::move(glm::dvec3 metres) {
    const glm::dvec3 right(-std::sin(heading_), 0, std::cos(heading_));
    eye_ += metres.x * right + metres.y * glm::dvec3(0, 1, 0) + metres.z * ahead();
    eye_.y = std::clamp(eye_.y, -50.0, highest_m);
}

Camera ViewCamera::camera() const {
    return {.position_m = eye_, .target_m = eye_ + distance_ * ahead(), .vertical_view_rad = vertical_view_rad_};
}

}  // namespace pelagic::viewer
