#include "pelagic/tests/openxr_runtime/poses.hpp"

#include <cmath>
#include <glm/trigonometric.hpp>

namespace pelagic::openxr_stand_in {
namespace {

constexpr double eye_distance_m = 0.064;
constexpr float outer_rad = 0.942f, inner_rad = 0.698f, up_rad = 0.768f, down_rad = 0.960f;

}  // namespace

Pose pose_of(const XrPosef& pose) {
    const XrQuaternionf& q = pose.orientation;
    const XrVector3f& p = pose.position;
    return {glm::normalize(glm::dquat(q.w, q.x, q.y, q.z)), {p.x, p.y, p.z}};
}

XrPosef xr_pose_of(const Pose& pose) {
    const glm::quat q(pose.turn);
    const glm::vec3 p(pose.place_m);
    return {{q.x, q.y, q.z, q.w}, {p.x, p.y, p.z}};
}

Pose head_at(XrTime time) {
    const double t = static_cast<double>(time % 1'000'000'000'000) * 1e-9;
    const double yaw = 0.5 * std::sin(0.9 * t), pitch = -0.35 * std::sin(0.45 * t), roll = 0.05 * std::sin(1.3 * t);
    return {glm::angleAxis(yaw, glm::dvec3(0, 1, 0)) * glm::angleAxis(pitch, glm::dvec3(1, 0, 0)) *
                glm::angleAxis(roll, glm::dvec3(0, 0, 1)),
            {0.2 * std::sin(0.7 * t), 0.05 * std::sin(1.1 * t), 0.1 * std::sin(0.5 * t)}};
}

const std::array<EyeOfHead, 2>& eyes_of_head() {
    static const std::array<EyeOfHead, 2> eyes = {
        EyeOfHead{{{1, 0, 0, 0}, {-eye_distance_m / 2, 0, 0}}, {-outer_rad, inner_rad, up_rad, -down_rad}},
        EyeOfHead{{{1, 0, 0, 0}, {eye_distance_m / 2, 0, 0}}, {-inner_rad, outer_rad, up_rad, -down_rad}}};
    return eyes;
}

}  // namespace pelagic::openxr_stand_in
