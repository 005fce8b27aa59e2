// A small wooden boat, for the viewer and the web page. Local axes: x forward, y up from the
// waterline, z to starboard.
#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "pelagic/gl/meshes/lit_mesh.hpp"

namespace pelagic::gl {

class Boat : public LitMesh {
   public:
    static constexpr float length_m = 7.2f, beam_m = 2.5f, draught_m = 0.55f;

    /// A closed surface in the boat's axes, wound counter-clockwise as seen from outside, for
    /// HullMesh.
    struct Surface {
        std::vector<glm::dvec3> vertices;
        std::vector<std::array<std::uint32_t, 3>> triangles;
    };
    /// Returns the hull, closed by a lid at the gunwale.
    static Surface hull();
    /// Returns the space inside the planking, up to the gunwale, for ExclusionMap.
    static Surface interior();

    /// \throws GlError if the driver rejects a shader
    explicit Boat(const Functions& gl);
};

}  // namespace pelagic::gl
