// An image as a file that every viewer opens.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>

namespace openxr_application {

/// As PPM. \param rgba  the lower row first. Throws std::runtime_error.
void write_image(const std::filesystem::path& file, std::span<const std::uint8_t> rgba, int width, int height);

}  // namespace openxr_application
