// What a view can see: six planes out of its matrix, and boxes that are certainly outside of them.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace pelagic {

struct Box {
    glm::dvec3 centre{};
    glm::dvec3 half{};  ///< half extents, metres
};

/// The depths that a clip space keeps. A matrix alone does not tell.
enum class ClipDepth {
    either,            ///< takes the wider one, -w to w: loses nothing, may keep what lies beyond a depth plane
    minus_one_to_one,  ///< OpenGL: -w <= z <= w
    zero_to_one        ///< Vulkan, Direct3D, Metal, glClipControl: 0 <= z <= w
};

/// The half spaces dot(plane.xyz, p) + plane.w >= 0 of a clip volume.
///
/// Planes are the sums and differences of the matrix' rows (Gribb and Hartmann 2001). Forward and reversed depth, with
/// a far plane or without, perspective or not: an infinite far plane yields a half space that holds everything.
struct Frustum {
    std::array<glm::dvec4, 6> planes{};

    /// Throws std::invalid_argument if the matrix has no inverse or holds something that is no number.
    explicit Frustum(const glm::dmat4& clip_from_world, ClipDepth depth = ClipDepth::either);

    /// False only if the box is outside: its corner furthest along a plane's normal, the positive vertex, lies behind
    /// that plane (VR Ocean, equations 59 and 60).
    bool may_see(const Box& box) const;
};

}  // namespace pelagic
