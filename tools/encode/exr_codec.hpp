// Interface of the library pelagic_exr, which the tool loads on the first EXR file that an export
// writes. OpenEXR loads in a fiftieth of the time of OpenImageIO.
//
//   file   one or several parts, each an image with its own name and attributes. Every reader
//          supports files of one part
//   part   one size, with one level or a mip chain down to one pixel
//   layer  a group of channels: "displacement.R", "displacement.G", "displacement.B"
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "pelagic/tools/files/sample.hpp"
#include "pelagic/tools/maps/map_image.hpp"

namespace pelagic::tools {

struct ExrLayer {
    std::vector<std::string> channels;  ///< full names, in the order of the values of a pixel
    Sample sample;                      ///< half or float32; EXR has no 8-bit samples
    /// called once for each level, when the level is written
    std::function<MapImage(int level)> image_of;
};

using ExrAttribute = std::pair<std::string, std::variant<std::string, int, double>>;

struct ExrPart {
    std::string name;  ///< may be empty in a file of one part
    int side = 0;
    int levels = 1;
    std::vector<ExrLayer> layers;
    std::vector<ExrAttribute> attributes;
    std::optional<double> frames_per_second;  ///< unset: unknown
};

struct ExrFile {
    std::vector<ExrPart> parts;  ///< at least one
    bool is_tiled = false;       ///< in tiles of 64 x 64 pixels; required for mip levels
    Compression compression = Compression::zip;
};

/// Function table that the library exports as `pelagic_exr_codec`.
struct ExrCodec {
    const char* version;  ///< of Pelagic; must equal the tool's version
    /// Encodes the file in memory. The bytes are identical on every machine. Works on the calling
    /// thread, one level of one part at a time. Throws std::runtime_error with OpenEXR's reason.
    std::vector<unsigned char> (*encode)(const ExrFile& file);
};

/// Returns the function table; the first call loads the library from its path relative to the tool.
/// Thread-safe. Throws FileError that names the library file.
const ExrCodec& exr_codec();

}  // namespace pelagic::tools
