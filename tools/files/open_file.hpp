// How a system opens files, in one file for each: open_file_posix.cpp, open_file_windows.cpp.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

#include "pelagic/tools/files/descriptor.hpp"

namespace pelagic::tools {

/// Not open if that can't be done; errno says why, EISDIR for a folder where the system knows that only when it is read.
Descriptor open_to_read(const std::filesystem::path& file);

/// What read() says: bytes that came, 0 at the end, -1 with errno.
std::ptrdiff_t read_some(int descriptor, std::span<char> bytes);

/// From here on standard input and output are bytes as they are: a line ends with "\n" everywhere.
void keep_bytes_as_they_are();

}  // namespace pelagic::tools
