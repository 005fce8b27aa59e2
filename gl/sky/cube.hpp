// The faces of a cube map on the CPU.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

namespace pelagic::gl {

/// Six square faces of RGB texels.
struct Cube {
    int side = 0;  ///< texels along a side of a face
    std::vector<glm::vec3> texels;

    explicit Cube(int size) : side(size), texels(std::size_t{6} * size * size) {}
    glm::vec3& at(int face, int x, int y) {
        return texels[(static_cast<std::size_t>(face) * side + y) * side + static_cast<std::size_t>(x)];
    }
    const glm::vec3& at(int face, int x, int y) const { return const_cast<Cube*>(this)->at(face, x, y); }
    /// Returns the direction through the centre of a texel; a unit vector.
    glm::vec3 direction(int face, int x, int y) const;
    /// Returns the texel whose direction is that of another texel, reflected at the horizontal
    /// plane.
    const glm::vec3& mirrored(int face, int x, int y) const {
        const int top = 2, bottom = 3;
        return at(face == bottom ? top : face == top ? bottom : face, x, side - 1 - y);
    }
    /// Samples with bilinear interpolation within a face, clamped at its edges, which suffices for
    /// averages.
    glm::vec3 sample(glm::vec3 direction) const;
};

}  // namespace pelagic::gl
