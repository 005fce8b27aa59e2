// EXR files by OpenEXR, within the library pelagic_images.
#pragma once

#include "pelagic/tools/encode/exr_file.hpp"

namespace pelagic::tools {

/// The file in memory, the same bytes on every machine. Works on the calling thread, a level of a part at a time. Throws
/// std::runtime_error with OpenEXR's reason.
std::vector<unsigned char> encode_exr(const ExrFile& file);

}  // namespace pelagic::tools
