// The image files of a frame: what is in each, and its bytes.
#pragma once

#include <string>
#include <vector>

#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/export/export_options.hpp"
#include "pelagic/tools/export/texture_image.hpp"

namespace pelagic::tools {

/// A map of a cascade, with so many levels of its chain; or the dynamic-wave grid.
struct ImagePart {
    MapKind map;
    int cascade = 0;  ///< 0 is the coarsest
    int first_level = 0;
    int levels = 1;
};

struct ImageFile {
    std::string name;
    std::vector<ImagePart> parts;
};

/// All of a frame, in the order in which records list them.
std::vector<ImageFile> image_files(const ExportOptions& options, int frame);

/// Throws std::runtime_error with OpenImageIO's or OpenEXR's reason, and FileError if the library that writes images is not
/// there. \param number  of the frame
std::vector<unsigned char> encode_image_file(const ImageFile& file, const Frame& frame, int number,
                                             const ExportOptions& options);

/// Pixels of a map as a file of the options' format. Formats without levels take the first. Throws likewise.
std::vector<unsigned char> encode_pixels(MapKind map, const std::vector<TextureImage>& levels,
                                         const MapOptions& options);

}  // namespace pelagic::tools
