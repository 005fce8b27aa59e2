// Functions for Windows only.
#pragma once

#include <filesystem>
#include <string>

#include "pelagic/tools/files/descriptor.hpp"

namespace pelagic::tools {

/// Opens a file in binary mode at a path of any length. Until it is closed, other processes may
/// read and write it, but neither rename nor remove it. On failure the descriptor is not open and errno holds the reason.
/// \param how  _O_RDONLY, _O_WRONLY or _O_RDWR, and _O_CREAT, _O_EXCL and _O_APPEND
Descriptor open_binary(const std::filesystem::path& file, int how);

/// Returns the errno of GetLastError().
int errno_of_last_error();

/// Converts UTF-16, such as an argument of the command line.
std::string utf8_of(const wchar_t* text);

}  // namespace pelagic::tools
