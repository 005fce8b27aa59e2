// The uniform block of gl/shaders/scene.glsl, which says what each value is. Layout std140: matrices and vec4 only.
#pragma once

#include <array>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include "pelagic/sim/frame.hpp"

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

/// What the uploaded frame says of itself, and how its textures and the framebuffer are made.
struct SeaFacts {
    SeaState sea;
    SeaFigures figures;
    float whitecap_jacobian = 0;
    double time_s = 0;
    bool has_displacement_mips = false;
    bool framebuffer_is_srgb = false;
};

/// The light of a baked sky, as sky.hpp has it.
struct SkyLight {
    int levels = 1;
    glm::vec3 sun_direction{0, 1, 0}, sun_irradiance{1}, sky_irradiance{1}, haze_per_m{0};
    float exposure = 1;
};

struct DrawInput;
SceneBlock scene_block_of(const DrawInput& input, const SeaFacts& sea, const SkyLight& sky);

}  // namespace pelagic::gl
