// Small water, which the cascades do not model: a lake, a coast, a river, a pond. Shaders generate
// its waves from a few octaves (gl/shaders/small_water.glsl); this file computes their parameters.
// Wind and loop period come from the frame, whose cascades are not drawn.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/message/enum_names.hpp"

namespace pelagic::gl {

/// Kind of water surface. gl/shaders/scene.glsl defines the same numbers.
enum class Surface {
    open,   ///< the frame's cascades
    lake,   ///< noise of 3 m to 3 cm on a level mesh, rougher in gusts
    coast,  ///< ridges of 12 m to 10 cm that displace the mesh, with foam on the sharpest
    river,  ///< noise of 1 m to 1 cm that a flow map advects, on a level mesh
    pond,   ///< waves of 1.2 m to 3 cm with sharp crests that displace the mesh
};

/// Extent of a flow map. The corner of its first texel is at x = z = 0, and the map repeats.
struct FlowExtent {
    double side_m = 160;       ///< above 0
    double fastest_mps = 1.5;  ///< speed of the byte 255; above 0
};

/// Velocities of a river's surface, constant in time.
struct FlowMap {
    FlowExtent extent;
    int side = 0;  ///< texels, 1 to 4096; columns run along x, rows along z
    /// 2 side^2 bytes: x and z of the velocity. 128 is zero and 255 is fastest_mps.
    std::vector<std::uint8_t> velocities;
};

/// Returns an empty string if the map is valid, else a message about the first invalid field:
/// "side is 0, expected 1 to 4096".
std::string check(const FlowMap& map);

/// Returns a winding channel along x. The flow is fastest in the middle and on the outside of
/// bends, and zero beyond the banks.
FlowMap winding_channel();

struct SceneBlock;
struct SeaFacts;
/// Sets the members of the uniform block for facts.surface.
/// \param in_water  x and z of the viewer in the water's frame
/// \param viewer    x and z of the viewer in the world, for the flow of a river
void place_small_water(SceneBlock& block, const SeaFacts& facts, glm::dvec2 in_water, glm::dvec2 viewer);

}  // namespace pelagic::gl

namespace pelagic {

template <>
struct EnumNames<gl::Surface> {
    static constexpr std::array<std::string_view, 5> all = {"open", "lake", "coast", "river", "pond"};
};

}  // namespace pelagic
