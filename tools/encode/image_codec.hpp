// Interface of the library pelagic_images, which the tool loads on the first image that it reads or
// writes, except EXR files of an export (see exr_codec.hpp). OpenImageIO depends on 250 shared
// libraries; loading them would take most of the run time of other commands.
#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pelagic/tools/files/sample.hpp"

namespace pelagic::tools {

/// Describes pixels in memory: top row first, channels interleaved, without padding.
struct ImageDescription {
    const char* extension;  ///< names the format: "exr", "png" or "tif"
    int width, height, channels;
    Sample sample;
    const char* colour_space;  ///< OpenImageIO's name
    const char* compression;   ///< OpenImageIO's name; null: the default of the format
    std::optional<int> png_level = {};  ///< zlib level, 1 to 9; unset: the default of the format
    /// the fourth channel is data, not coverage; others are not premultiplied
    bool has_unassociated_alpha = false;
    /// EXR names of the channels; empty: R, G, B and A
    std::vector<std::string> channel_names = {};
};

/// Function table that the library exports as `pelagic_image_codec`.
struct ImageCodec {
    const char* version;  ///< of Pelagic; must equal the tool's version
    /// Encodes an image file in memory. Throws std::runtime_error with OpenImageIO's reason.
    std::vector<unsigned char> (*encode)(const ImageDescription& image, const void* pixels);
    /// Decodes a file in memory to floats: top row first, channels interleaved. Throws
    /// std::runtime_error with OpenImageIO's reason, or if width, height or channels differ from
    /// those of `image`, before it allocates pixels.
    std::vector<float> (*decode)(const ImageDescription& image, std::span<const unsigned char> file);
    /// Decodes one channel, given by its full name such as "displacement_c1.G", from any part of an
    /// EXR file. Allocates memory for this channel only. Throws as decode() does.
    std::vector<float> (*decode_channel)(const ImageDescription& image, std::span<const unsigned char> file,
                                         const char* channel);
    /// Sets the width, height and channels of an image whose extension is set. Throws
    /// std::runtime_error with OpenImageIO's reason.
    void (*measure)(ImageDescription& image, std::span<const unsigned char> file);
};

/// Returns the function table; the first call loads the library from its path relative to the tool.
/// Thread-safe. Throws FileError that names the library file.
const ImageCodec& image_codec();

/// Encodes RGBA8 pixels, top row first, as an sRGB PNG without alpha.
std::vector<unsigned char> encode_png(std::span<const std::uint8_t> rgba, int width, int height);

/// Encodes linear radiance as an EXR file of 32-bit floats.
/// \param rgb  top row first
std::vector<unsigned char> encode_light(std::span<const float> rgb, int width, int height);

/// As above, with further channels.
/// \param names   EXR names of the further channels
/// \param values  of these channels for each pixel, top row first
std::vector<unsigned char> encode_light(std::span<const float> rgb, std::span<const std::string> names,
                                        std::span<const float> values, int width, int height);

}  // namespace pelagic::tools
