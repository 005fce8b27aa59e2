// Zstandard frames (RFC 8878), if the build found libzstd.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace pelagic::tools {

/// Returns false if Pelagic was built without libzstd.
bool has_zstd();

/// Compresses the bytes to one frame, whose header contains the content size. Throws FileError if
/// Pelagic was built without libzstd.
std::vector<unsigned char> zstd_frame(std::span<const unsigned char> bytes);

/// Decompresses a frame whose content has `size` bytes. Throws std::runtime_error if the frame is
/// damaged or has another size, and FileError if Pelagic was built without libzstd.
std::vector<unsigned char> zstd_content(std::span<const unsigned char> frame, std::size_t size);

}  // namespace pelagic::tools
