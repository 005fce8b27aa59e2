// A texture for graphics APIs, pixels of one format and their mip levels, and its files: DDS of
// Direct3D, with the Direct3D 10 header (Microsoft, Programming Guide for DDS), and KTX 2.0 of OpenGL,
// Vulkan, WebGL and WebGPU (Khronos, KTX File Format Specification 2.0, revision 4).
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "pelagic/tools/files/sample.hpp"

namespace pelagic::tools {

struct Texture {
    int width, height;
    int channels;  ///< 1, 2 or 4: graphics APIs need not support three channels
    Sample sample;
    /// Top row first, channels interleaved, without padding, least significant byte first. Level p
    /// has max(1, width >> p) x max(1, height >> p) texels. The largest level comes first.
    std::vector<std::span<const unsigned char>> levels;
};

/// Returns the bytes of a texel with all channels.
std::size_t bytes_of_texel(const Texture& texture);

/// Returns the bytes of a level.
std::size_t bytes_of_level(const Texture& texture, int level);

/// Returns an empty text if a file can hold the texture, else the error: "level 1 has 12 bytes,
/// needs 16".
std::string check(const Texture& texture);

/// Encodes a two-dimensional texture, largest level first. The header marks a fourth channel as
/// custom data, not opacity.
/// \pre check(texture) is empty (asserted)
std::vector<unsigned char> dds_file(const Texture& texture);

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
