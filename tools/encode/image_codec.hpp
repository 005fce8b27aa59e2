// Between the tool and the library that it opens when an image is written or read, pelagic_images: OpenImageIO needs 250 shared
// libraries, which would take most of the time of every other command.
#pragma once

#include <span>
#include <vector>

#include "pelagic/tools/encode/exr_file.hpp"
#include "pelagic/tools/files/sample.hpp"

namespace pelagic::tools {

/// Pixels in memory: rows from the top, channels interleaved, no gaps.
struct ImageDescription {
    const char* extension;  ///< names the format: "exr", "png" or "tif"
    int width, height, channels;
    Sample sample;
    const char* colour_space;             ///< as OpenImageIO names it
    const char* compression;              ///< as OpenImageIO names it; none for the format's own
    int png_level = 0;                    ///< zlib's, 1 to 9; 0 for the format's own
    bool has_unassociated_alpha = false;  ///< the fourth channel is no coverage, and nothing is multiplied by it
};

/// What the library exports as `pelagic_image_codec`.
struct ImageCodec {
    const char* version;  ///< of Pelagic: the library and the tool are built together
    /// The image's file in memory. Throws std::runtime_error with OpenImageIO's reason.
    std::vector<unsigned char> (*encode)(const ImageDescription& image, const void* pixels);
    /// An EXR file in memory, on the calling thread. Throws std::runtime_error with OpenEXR's reason.
    std::vector<unsigned char> (*encode_exr)(const ExrFile& file);
    /// The pixels of a file in memory as floats, rows from the top, channels interleaved. Throws std::runtime_error with
    /// OpenImageIO's reason, or if the image's width, height or channels are not `image`'s, before it makes room for any.
    std::vector<float> (*decode)(const ImageDescription& image, std::span<const unsigned char> file);
    /// The same of one channel, by its full name, "displacement_c1.G" in whichever part of an EXR file it is. Makes room for no other.
    std::vector<float> (*decode_channel)(const ImageDescription& image, std::span<const unsigned char> file,
                                         const char* channel);
    /// Sets the width, height and channels of an image whose extension is known. Throws likewise.
    void (*measure)(ImageDescription& image, std::span<const unsigned char> file);
};

/// The library beside the tool, opened by the first call, from any thread. Throws FileError that names the file.
const ImageCodec& image_codec();

}  // namespace pelagic::tools
