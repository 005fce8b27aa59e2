#include "image.hpp"

#include <string>

#include "whole_file.hpp"

namespace openxr_application {

void write_image(const std::filesystem::path& file, std::span<const std::uint8_t> rgba, int width, int height) {
    std::string ppm = "P6\n" + std::to_string(width) + ' ' + std::to_string(height) + "\n255\n";
    for (int row = height; row-- > 0;)
        for (int column = 0; column < width; ++column)
            for (int channel = 0; channel < 3; ++channel)
                ppm += static_cast<char>(
                    rgba[4 * static_cast<std::size_t>(row * width + column) + static_cast<std::size_t>(channel)]);
    write_whole_file(file, ppm);
}

}  // namespace openxr_application
