// The poses of the stand-in's head and eyes.
#pragma once

#include <openxr/openxr.h>

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace pelagic::openxr_stand_in {

struct Pose {
    glm::dquat turn{1, 0, 0, 0};
    glm::dvec3 place_m{0};

    /// Applies `other` first, then this pose.
    Pose operator*(const Pose& other) const { return {turn * other.turn, place_m + turn * other.place_m}; }
    Pose inverse() const {
        const glm::dquat back = glm::conjugate(turn);
        return {back, back * -place_m};
    }
};

Pose pose_of(const XrPosef& pose);
XrPosef xr_pose_of(const Pose& pose);

/// Returns the pose in the space LOCAL: upright at first, then looking around and down at the
/// water, swaying.
Pose head_at(XrTime time);

/// Returns the left and the right eye in the space of the head: 64 mm apart, parallel, with a
/// larger field of view on the outer side (a Quest's fields of view).
struct EyeOfHead {
    Pose pose;
    XrFovf fov;
};
const std::array<EyeOfHead, 2>& eyes_of_head();

}  // namespace pelagic::openxr_stand_in
