// DDS, the texture container of Direct3D, with the Direct3D 10 header (Microsoft, Programming Guide
// for DDS).
#pragma once

#include <vector>

#include "pelagic/tools/encode/texture.hpp"

namespace pelagic::tools {

/// Encodes a two-dimensional texture, largest level first. The header marks a fourth channel as
/// custom data, not opacity.
/// \pre check(texture) is empty (asserted)
std::vector<unsigned char> dds_file(const Texture& texture);

}  // namespace pelagic::tools
