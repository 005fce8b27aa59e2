// KTX 2.0, the texture container for OpenGL, Vulkan, WebGL and WebGPU (Khronos, KTX File Format
// Specification 2.0, revision 4).
#pragma once

#include <cstddef>
#include <span>
#include <vector>

#include "pelagic/tools/encode/texture.hpp"

namespace pelagic::tools {

enum class Supercompression { none, zstd };

/// Encodes a two-dimensional texture, smallest level first as the format requires. The values are
/// not colours: transfer function linear, primaries unspecified. The first row is the top row
/// (KTXorientation "rd"). Throws FileError for zstd if Pelagic was built without libzstd.
/// \pre check(texture) is empty (asserted)
std::vector<unsigned char> ktx2_file(const Texture& texture, Supercompression supercompression);

/// Decodes one channel of the largest level: side x side texels, top row first.
/// \throws std::runtime_error  with the reason, if the file is damaged, has another size, or does
/// not have four halves or floats per texel
/// \throws FileError  if the file is compressed and Pelagic was built without libzstd
std::vector<float> ktx2_channel(std::span<const unsigned char> file, int side, std::size_t channel);

}  // namespace pelagic::tools
