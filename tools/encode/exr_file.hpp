// An OpenEXR file before it is bytes: parts, the layers in each, and what it says about itself.
//
//   file   several images, each with a name and attributes of its own: parts. A file of one part is what every reader knows
//   part   one size, with one level or a chain of them down to one pixel
//   layer  channels that belong together, "displacement.R", "displacement.G", "displacement.B"
#pragma once

#include <functional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "pelagic/tools/files/image_compression.hpp"
#include "pelagic/tools/maps/map_image.hpp"

namespace pelagic::tools {

struct ExrLayer {
    std::vector<std::string> channels;            ///< by their full names, in the order of the pixels' values
    Sample sample;                                ///< half or float32: EXR has no bytes
    std::function<MapImage(int level)> image_of;  ///< asked for once a level, when it is written
};

using ExrAttribute = std::pair<std::string, std::variant<std::string, int, double>>;

struct ExrPart {
    std::string name;  ///< may be none in a file of one part
    int side = 0;
    int levels = 1;
    std::vector<ExrLayer> layers;
    std::vector<ExrAttribute> attributes;
    double frames_per_second = 0;  ///< 0 where it isn't known
};

struct ExrFile {
    std::vector<ExrPart> parts;  ///< at least one
    bool is_tiled = false;       ///< in squares of 64 x 64 pixels; only then there are levels
    Compression compression = Compression::zip;
};

}  // namespace pelagic::tools
