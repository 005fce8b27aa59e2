// Atomic writing of files.
#pragma once

#include <filesystem>
#include <string_view>

namespace openxr_application {

/// Writes a temporary file and renames it, so that a failure keeps an existing file.
/// \throws std::runtime_error  if the file cannot be written
void write_whole_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace openxr_application
