// Zstandard frames (RFC 8878), where the build found libzstd.
#pragma once

#include <span>
#include <vector>

namespace pelagic::tools {

/// False if Pelagic was built without libzstd.
bool has_zstd();

/// One frame that says how long its content is. Throws FileError if Pelagic was built without libzstd.
std::vector<unsigned char> zstd_frame(std::span<const unsigned char> bytes);

}  // namespace pelagic::tools
