// KTX 2.0, the container of textures for OpenGL, Vulkan, WebGL and WebGPU (Khronos, KTX File Format Specification 2.0, revision 4).
#pragma once

#include <vector>

#include "pelagic/tools/images/texture.hpp"

namespace pelagic::tools {

enum class Supercompression { none, zstd };

/// A two-dimensional texture, its levels with the smallest first, as the format wants them. The numbers are no colours: transfer
/// function linear, primaries unspecified. The first row is the upper one (KTXorientation "rd"). Throws FileError for zstd if
/// Pelagic was built without libzstd.
/// \pre check(texture) is empty (asserted)
std::vector<unsigned char> ktx2_file(const Texture& texture, Supercompression supercompression);

}  // namespace pelagic::tools
