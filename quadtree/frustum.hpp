// View frusta: the six clip planes of a view-projection matrix, and conservative culling of boxes.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

namespace pelagic {

struct Box {
    glm::dvec3 centre{};
    glm::dvec3 half{};  ///< half extents in metres
};

/// The depth range of a clip space, which cannot be derived from a matrix.
enum class ClipDepth {
    either,            ///< the wider range, -w to w: may keep boxes beyond a depth plane
    minus_one_to_one,  ///< OpenGL: -w <= z <= w
    zero_to_one        ///< Vulkan, Direct3D, Metal, glClipControl: 0 <= z <= w
};

/// The half spaces dot(plane.xyz, p) + plane.w >= 0 of a clip volume.
///
/// Planes are sums and differences of the rows of the matrix (Gribb and Hartmann 2001). Supports
/// forward and reversed depth, finite and infinite far planes, perspective and orthographic
/// projections. An infinite far plane yields a half space that contains every point.
struct Frustum {
    std::array<glm::dvec4, 6> planes{};

    /// Extracts the planes of the matrix.
    /// \throws std::invalid_argument  if the matrix is singular or contains NaN or infinity
    explicit Frustum(const glm::dmat4& clip_from_world, ClipDepth depth = ClipDepth::either);

    /// Returns false only if the box is outside: its positive vertex, the corner furthest along a
    /// plane's normal, lies behind that plane (VR Ocean, equations 59 and 60).
    bool may_see(const Box& box) const;
};

}  // namespace pelagic
