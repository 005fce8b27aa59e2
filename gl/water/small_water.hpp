// Water that is too small for the sea's cascades: a lake, a coast, a river, a pond. Shaders make it from a few octaves
// (gl/shaders/small_water.glsl); here is what they are told. Wind and loop are the frame's, its cascades are not drawn.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace pelagic::gl {

/// As gl/shaders/scene.glsl numbers them.
enum class Surface {
    open,   ///< the frame's cascades
    lake,   ///< bumps of 3 m to 3 cm on a level plane, rougher in gusts
    coast,  ///< ridges of 12 m to 10 cm that stand up, white on the sharpest
    river,  ///< bumps of a metre to a centimetre that a map carries along, on a level plane
    pond,   ///< waves of 1.2 m to 3 cm with sharp crests, that stand up
};

/// "open", "lake", "coast", "river", "pond", in the order of the values.
std::span<const std::string_view> surface_names();
std::optional<Surface> surface_named(std::string_view name);

/// Where a map of a flow lies: its first texel's corner is at x = z = 0, and it repeats.
struct FlowExtent {
    double side_m = 160;
    double fastest_mps = 1.5;  ///< what the largest byte means
};

/// Velocities of a river's surface, constant in time.
struct FlowMap {
    FlowExtent extent;
    int side = 0;  ///< texels, 1 to 4096; column i lies along x, row j along z
    /// 2 side^2: x and z of the velocity, 128 is none, 255 the fastest.
    std::vector<std::uint8_t> velocities;
};

/// Empty if usable, else the first bad field: "side is 0, needs 1 to 4096".
std::string check(const FlowMap& map);

/// A channel along x that winds, fast in its middle and on the outside of its bends, still beyond its banks.
FlowMap winding_channel();

struct SceneBlock;
struct SeaFacts;
void place_small_water(SceneBlock& block, const SeaFacts& facts, glm::dvec2 viewer);

}  // namespace pelagic::gl
