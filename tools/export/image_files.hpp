// Image files of a frame: their names, contents and encoding.
#pragma once

#include <string>
#include <vector>

#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/export/export_options.hpp"
#include "pelagic/tools/export/texture_image.hpp"

namespace pelagic::tools {

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

}  // namespace pelagic::tools
