// Zstandard frames (RFC 8878), where the build found libzstd.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace pelagic::tools {

/// False if Pelagic was built without libzstd.
bool has_zstd();

/// One frame that says how long its content is. Throws FileError if Pelagic was built without libzstd.
std::vector<unsigned char> zstd_frame(std::span<const unsigned char> bytes);

/// The content of a frame, which has `size` bytes. Throws std::runtime_error if it has not or is damaged, and FileError if Pelagic
/// was built without libzstd.
std::vector<unsigned char> zstd_content(std::span<const unsigned char> frame, std::size_t size);

}  // namespace pelagic::tools
