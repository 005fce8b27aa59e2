// Validation of the headers of an OpenEXR file before OpenImageIO reads it. OpenImageIO compares
// each attribute with all earlier ones, and allocates the sizes that attributes and channel counts
// claim, however small the file is.
//
//   file       magic number, version, headers of parts ("OpenEXR File Layout", openexr.com)
//   header     attributes, then a null byte; in a multi-part file another null byte ends the
//              headers
//   attribute  name, null, type, null, int32 size, bytes
#pragma once

#include <cstddef>
#include <span>

namespace pelagic::tools {

struct ExrHeaderSize {
    std::size_t attributes = 0;  ///< of all parts
    std::size_t channels = 0;    ///< of all parts
};

/// Counts attributes and channels without allocating memory.
/// \throws std::runtime_error  with the reason, if the headers are malformed or truncated, have
/// more than 4,000 attributes or exceed 1 MiB. An export with all maps of four cascades has 28
/// parts of 20 attributes each
ExrHeaderSize read_exr_header(std::span<const unsigned char> file);

}  // namespace pelagic::tools
