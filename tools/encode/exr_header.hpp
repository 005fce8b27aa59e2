// The headers of an OpenEXR file, read before a library is trusted with it: OpenImageIO compares each attribute with all before
// it and makes room for what an attribute or a number of channels asks for, however small the file is.
//
//   file    magic number, version, headers of parts                "OpenEXR File Layout", openexr.com
//   header  attributes, then a null byte; in a file of several parts one more null byte ends the headers
//   attribute  name, null, type, null, int32 size, bytes
#pragma once

#include <cstddef>
#include <span>

namespace pelagic::tools {

struct ExrHeaderSize {
    std::size_t attributes = 0;  ///< of all parts
    std::size_t channels = 0;    ///< of all parts
};

/// Counts without allocating. Throws std::runtime_error with the reason if the headers are malformed, end behind the file, or have more
/// than 4,000 attributes or more than 1 MiB: an export with all maps of four cascades in parts has 28 parts of 20 attributes each.
ExrHeaderSize read_exr_header(std::span<const unsigned char> file);

}  // namespace pelagic::tools
