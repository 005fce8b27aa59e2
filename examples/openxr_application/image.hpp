// Image files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace openxr_application {

/// Writes a PPM file.
/// \param rgba  pixels, the lower row first
/// \throws std::runtime_error  if the file cannot be written
void write_image(const std::filesystem::path& file, std::span<const std::uint8_t> rgba, int width, int height);

}  // namespace openxr_application
