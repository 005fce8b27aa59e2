// Image files of a frame: their names, contents and encoding.
#pragma once

#include <string>
#include <vector>

#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/encode/exr_codec.hpp"
#include "pelagic/tools/export/export_options.hpp"
#include "pelagic/tools/maps/map_options.hpp"

namespace pelagic::tools {

/// Pixels of a map, or of many side by side: interleaved, top row first, without padding.
struct TextureImage {
    int width = 0, height = 0, channels = 0;
    Sample sample = Sample::uint8;
    std::vector<std::byte> pixels;
};

/// Encodes a KTX2 or DDS file. Adds a fourth channel of 1 to three channels, since graphics APIs
/// need not support textures of three. Throws FileError for Zstandard if Pelagic was built without
/// libzstd.
/// \param levels  the largest first; each has half the width and height of the previous one
/// \pre options.format is a texture format (asserted)
std::vector<unsigned char> encode_texture(const std::vector<TextureImage>& levels, const MapOptions& options);

/// A map of a cascade with a range of mip levels; or the dynamic-wave grid.
struct ImagePart {
    MapKind map;
    int cascade = 0;  ///< 0: the coarsest
    int first_level = 0;
    int levels = 1;
};

struct ImageFile {
    std::string name;
    std::vector<ImagePart> parts;
};

/// Returns the image files of a frame, in the order of records.
std::vector<ImageFile> image_files(const ExportOptions& options, int frame);

/// Loads the libraries that encode the files of an export, so that a missing library is reported
/// before anything is written. Throws FileError.
void load_codecs(const ExportOptions& options);

/// Encodes an image file.
/// \param number  number of the frame
/// \throws std::runtime_error  with OpenImageIO's or OpenEXR's reason
/// \throws FileError  if the library that writes the format is missing
std::vector<unsigned char> encode_image_file(const ImageFile& file, const Frame& frame, int number,
                                             const ExportOptions& options);

/// Encodes pixels of a map in the format of the options. Formats without mip levels store the first
/// level. Throws as encode_image_file() does.
std::vector<unsigned char> encode_pixels(MapKind map, const std::vector<TextureImage>& levels,
                                         const MapOptions& options);

/// Returns the description of an EXR file; `frame` must stay valid until the file is encoded.
/// Values of 8-bit maps are stored as halves, as fractions of 255.
///
/// Attributes: `wrapmodes` and `framesPerSecond` are standard attributes of OpenEXR. Others are
/// `pelagic:frame`, `pelagic:time_s`, `pelagic:loop_period_s`, `pelagic:axes`, `pelagic:rows`, and
/// for each map `pelagic:map`, `pelagic:cascade`, `pelagic:side_m`, `pelagic:rotation_cosine`,
/// `pelagic:rotation_sine`, `pelagic:channels`. If a part has several layers, the names contain the
/// layer: `pelagic:foam_c1:cascade`.
ExrFile exr_file(const ImageFile& file, const Frame& frame, int number, const ExportOptions& options);

}  // namespace pelagic::tools
