// Reads images with independent libraries: OpenEXR, libpng without its conversions, and OpenImageIO
// for TIFF.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace pelagic {

struct ReadImage {
    int width = 0, height = 0, channels = 0;
    std::string type;  ///< "uint8", "uint16", "half", "float"
    /// Interleaved rows, the top row first; integers are divided by 255 or 65535.
    std::vector<double> pixels;

    double at(int column, int row, int channel) const {
        return pixels[static_cast<std::size_t>((row * width + column) * channels + channel)];
    }
};

/// Reads an image; the format follows from the name's extension. Channels are in the order R, G, B,
/// A, or Y alone. If the file cannot be read, the test fails and the image is empty.
ReadImage read_image(const std::filesystem::path& file);

}  // namespace pelagic
