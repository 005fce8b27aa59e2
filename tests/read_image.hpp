// Images as programs read them that know nothing of Pelagic: OpenEXR, libpng without its conversions, OpenImageIO for TIFF.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pelagic {

struct ReadImage {
    int width = 0, height = 0, channels = 0;
    std::string type;            ///< "uint8", "uint16", "half", "float"
    std::vector<double> pixels;  ///< rows from the top, interleaved; whole numbers as parts of 255 or 65535

    double at(int column, int row, int channel) const {
        return pixels[static_cast<std::size_t>((row * width + column) * channels + channel)];
    }
};

/// By the name's extension. Channels come in the order R, G, B, A, or Y alone. Fails the test and gives none if it can't be read.
ReadImage read_image(const std::filesystem::path& file);

}  // namespace pelagic
