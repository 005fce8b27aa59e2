// Images as image files, encoded in memory by the library of image_codec.hpp, which is opened for the first of them. They throw
// std::runtime_error with OpenImageIO's reason, and FileError if that library is not there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace pelagic::tools {

/// An image for people: sRGB PNG from RGBA8 pixels, the upper row first; their alpha is left out.
std::vector<unsigned char> encode_png(std::span<const std::uint8_t> rgba, int width, int height);

/// Linear light for programs: EXR, 32-bit floats. \param rgb  the upper row first
std::vector<unsigned char> encode_light(std::span<const float> rgb, int width, int height);

}  // namespace pelagic::tools
