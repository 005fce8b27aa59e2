// The uniform block of gl/shaders/scene.glsl, which says what each value is. Layout std140: matrices and vec4 only.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

namespace pelagic::gl {

struct SceneBlock {
    std::array<glm::mat4, 2> clip_from_viewer{}, viewer_from_clip{};
    std::array<glm::vec4, 2> eye{};
    glm::vec4 viewer{}, grid{}, fade{}, mesh{}, skirt{};
    glm::vec4 sun{}, sun_irradiance{}, sky_irradiance{}, haze{};
    glm::vec4 water_absorption{}, water_scattering{}, waves{};
    std::array<glm::vec4, 2> detail_turn{};
    glm::vec4 detail_shift{}, second_shift{}, noise_scale{}, foam_shift{}, gust_shift{};
    glm::vec4 output_kind{};
};

}  // namespace pelagic::gl
