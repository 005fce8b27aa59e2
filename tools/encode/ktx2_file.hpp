// KTX 2.0, the container of textures for OpenGL, Vulkan, WebGL and WebGPU (Khronos, KTX File Format Specification 2.0, revision 4).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "pelagic/tools/encode/texture.hpp"

namespace pelagic::tools {

enum class Supercompression { none, zstd };

/// A two-dimensional texture, its levels with the smallest first, as the format wants them. The numbers are no colours: transfer
/// function linear, primaries unspecified. The first row is the upper one (KTXorientation "rd"). Throws FileError for zstd if
/// Pelagic was built without libzstd.
/// \pre check(texture) is empty (asserted)
std::vector<unsigned char> ktx2_file(const Texture& texture, Supercompression supercompression);

/// One channel of the largest level of such a texture, side x side texels, rows from the top. Throws std::runtime_error with the
/// reason if it is damaged, has another size, or has other texels than four halves or floats; FileError as above.
std::vector<float> ktx2_channel(std::span<const unsigned char> file, int side, std::size_t channel);

}  // namespace pelagic::tools
