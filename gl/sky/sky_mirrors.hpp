// What mirrors of growing roughness show of a sky.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "pelagic/gl/sky/cube.hpp"

namespace pelagic::gl {

/// Hammersley's points on the square.
glm::vec2 hammersley(std::uint32_t i, std::uint32_t count);

/// One row of one face of a level from 1 on, counted through all of them: samples of GGX's lobe around the direction, each taken
/// from the average whose texels are as large as the sample (Karis 2013, "Real Shading in Unreal Engine 4"; Krivanek and
/// Colbert 2008, "Real-time Shading with Filtered Importance Sampling").
/// \param averages  box mips of level 0, side by side with the levels
void filter_mirror_row(const std::vector<Cube>& averages, std::vector<Cube>& mirrors, std::size_t row);

}  // namespace pelagic::gl
