// EXR encoding with OpenEXR; compiled into the library pelagic_images.
#pragma once

#include "pelagic/tools/encode/exr_file.hpp"

namespace pelagic::tools {

/// Encodes the file in memory. The bytes are identical on every machine. Works on the calling
/// thread, one level of one part at a time. Throws std::runtime_error with OpenEXR's reason.
std::vector<unsigned char> encode_exr(const ExrFile& file);

}  // namespace pelagic::tools
