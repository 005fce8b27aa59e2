// Tiles as image files, encoded in memory by the library of image_codec.hpp, which is opened for the first of them. Image
// row j is texel row j (z), column i is x. All of them throw std::runtime_error with OpenImageIO's reason, and FileError if
// that library is not there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/sim/tile.hpp"

namespace pelagic::tools {

enum class ImageFormat { exr_and_png, tiff };

/// Dx, height, Dz as the channels R, G, B in metres: EXR or TIFF, lossless, 32-bit floats or 16-bit halves (which are
/// the tile's own: rounded to nearest even once).
std::vector<unsigned char> encode_displacement(const Tile& tile, ImageFormat format, bool half);

/// One level of the gradient chain as RGBA8, PNG or TIFF, byte for byte: alpha is a smoothness, not a coverage, so
/// it is marked as unassociated, or OpenImageIO would divide the normals by it.
std::vector<unsigned char> encode_gradient(const Tile& tile, int level, ImageFormat format);

/// One level of the chain of foam as 8-bit grey, PNG or TIFF, byte for byte.
std::vector<unsigned char> encode_foam(const Tile& tile, int level, ImageFormat format);

/// A picture for people: sRGB PNG from RGBA8 pixels, the upper row first; their alpha is left out.
std::vector<unsigned char> encode_picture(std::span<const std::uint8_t> rgba, int width, int height);

/// Linear light for programs: EXR, 32-bit floats. \param rgb  the upper row first
std::vector<unsigned char> encode_light(std::span<const float> rgb, int width, int height);

/// "exr", "png" or "tif".
const char* displacement_extension(ImageFormat format);
const char* gradient_extension(ImageFormat format);

}  // namespace pelagic::tools
