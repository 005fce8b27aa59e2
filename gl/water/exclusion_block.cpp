// Uniforms for the interiors of hulls.
#include <glm/mat3x3.hpp>

#include "pelagic/gl/water/scene_block.hpp"
#include "pelagic/gl/water/sea_renderer.hpp"

namespace pelagic::gl {

void place_exclusions(SceneBlock& block, const DrawInput& input, std::span<const ExclusionMap> maps) {
    // A box that contains no position.
    block.exclusion_box.fill({0, 0, 0, -1});
    for (std::size_t i = 0; i < input.exclusions.size(); ++i) {
        const Exclusion& exclusion = input.exclusions[i];
        const ExclusionMap& map = maps[exclusion.map];
        const glm::dvec3 viewer = exclusion.in_hull(input.viewer()) - map.lower_m();
        const glm::dmat3 world_from_hull = glm::mat3_cast(exclusion.orientation);
        for (int axis = 0; axis < 3; ++axis)
            block.exclusion_box[3 * i + static_cast<std::size_t>(axis)] =
                glm::vec4(glm::dvec4(world_from_hull[axis], viewer[axis]) / map.size_m()[axis]);
        block.exclusion_map[i] = {map.columns(), map.rows(), exclusion.map, 0};
    }
}

}  // namespace pelagic::gl
