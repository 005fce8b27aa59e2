// Where the stand-in's head is, and its eyes.
#pragma once

#include <openxr/openxr.h>

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace pelagic::openxr_stand_in {

struct Pose {
    glm::dquat turn{1, 0, 0, 0};
    glm::dvec3 place_m{0};

    /// First the other one, then this one.
    Pose operator*(const Pose& other) const { return {turn * other.turn, place_m + turn * other.place_m}; }
    Pose inverse() const {
        const glm::dquat back = glm::conjugate(turn);
        return {back, back * -place_m};
    }
};

Pose pose_of(const XrPosef& pose);
XrPosef xr_pose_of(const Pose& pose);

/// In the space LOCAL: upright at first, then looking around and down at the water, swaying.
Pose head_at(XrTime time);

/// Left and right in the head's own space: 64 mm apart, parallel, each with more to see on its outer side (a Quest's fields of view).
struct EyeOfHead {
    Pose pose;
    XrFovf fov;
};
const std::array<EyeOfHead, 2>& eyes_of_head();

}  // namespace pelagic::openxr_stand_in
