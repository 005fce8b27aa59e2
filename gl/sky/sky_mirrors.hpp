// Prefiltered reflections of a sky for increasing roughness.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <vector>

#include "pelagic/gl/sky/cube.hpp"

namespace pelagic::gl {

/// Returns point i of the Hammersley sequence of `count` points on the unit square.
glm::vec2 hammersley(std::uint32_t i, std::uint32_t count);

/// Computes one row of one face of a level from 1. Importance-samples the GGX lobe around each
/// texel's direction. Each sample reads the box mip whose texels match the sample's solid angle
/// (Karis 2013, "Real Shading in Unreal Engine 4"; Krivanek and Colbert 2008, "Real-time Shading
/// with Filtered Importance Sampling").
/// \param averages  box mips of level 0, one for each level
/// \param mirrors  all levels; level 0 is not written
/// \param row  row number, counted through the faces of all levels from 1
void filter_mirror_row(const std::vector<Cube>& averages, std::vector<Cube>& mirrors, std::size_t row);

}  // namespace pelagic::gl
