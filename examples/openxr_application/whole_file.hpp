// A file that is there whole or not at all.
#pragma once

#include <filesystem>
#include <string_view>

namespace openxr_application {

/// Beside the file first, which what was there before outlives. Throws std::runtime_error.
void write_whole_file(const std::filesystem::path& file, std::string_view bytes);

}  // namespace openxr_application
