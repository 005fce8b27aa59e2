// Interface of the library pelagic_exr, which the tool loads on the first EXR file that an export
// writes. OpenEXR loads in a fiftieth of the time of OpenImageIO.
#pragma once

#include <vector>

#include "pelagic/tools/encode/exr_file.hpp"

namespace pelagic::tools {

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
