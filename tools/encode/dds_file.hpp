// DDS, Direct3D's container of textures, with the header of Direct3D 10 (Microsoft, Programming Guide for DDS).
#pragma once

#include <vector>

#include "pelagic/tools/encode/texture.hpp"

namespace pelagic::tools {

/// A two-dimensional texture, its levels with the largest first. A fourth channel is marked as no opacity.
/// \pre check(texture) is empty (asserted)
std::vector<unsigned char> dds_file(const Texture& texture);

}  // namespace pelagic::tools
