// Paths of UTF-8 text. Use these instead of the conversions of std::filesystem::path, which on Windows
// take text for Latin-1. path::string() returns UTF-8 on every system.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace pelagic::tools {

inline std::filesystem::path path_of(std::string_view utf8) { return std::u8string(utf8.begin(), utf8.end()); }

inline std::filesystem::path operator/(const std::filesystem::path& folder, const std::string& name) {
    return folder / path_of(name);
}
inline std::filesystem::path operator/(const std::filesystem::path& folder, const char* name) {
    return folder / path_of(name);
}

}  // namespace pelagic::tools
