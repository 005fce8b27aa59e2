// Encoding of images in memory, by the library of image_codec.hpp, which the first call loads.
// Functions throw std::runtime_error with OpenImageIO's reason, and FileError if the library is
// missing.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pelagic::tools {

/// Encodes RGBA8 pixels, top row first, as an sRGB PNG without alpha.
std::vector<unsigned char> encode_png(std::span<const std::uint8_t> rgba, int width, int height);

/// Encodes linear radiance as an EXR file of 32-bit floats.
/// \param rgb  top row first
std::vector<unsigned char> encode_light(std::span<const float> rgb, int width, int height);

}  // namespace pelagic::tools
