// RGBA images composed of rectangles, images and text, and images of maps.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "pelagic/tools/maps/map_image.hpp"

namespace pelagic::tools {

using Colour = std::array<std::uint8_t, 3>;

class RgbaImage {
   public:
    RgbaImage(int width, int height, Colour background);
    /// \param rgba  pixels, the upper row first
    RgbaImage(int width, int height, std::vector<std::uint8_t> rgba);

    int width() const { return width_; }
    int height() const { return height_; }
    /// Returns RGBA8 pixels, the upper row first.
    const std::vector<std::uint8_t>& pixels() const { return pixels_; }

    /// Fills a rectangle, clipped at the edges of the image.
    void fill(int left, int top, int width, int height, Colour colour);
    /// Copies an image, clipped at the edges of this image.
    void paste(int left, int top, const RgbaImage& other);

    /// Writes one line of ASCII in letters of 7 x 12 dots. Other characters become "?".
    /// \param dot  side of a dot in pixels
    void write(int left, int top, const std::string& text, Colour colour, int dot);

   private:
    int width_, height_;
    std::vector<std::uint8_t> pixels_;
};

struct MapPreview {
    RgbaImage image;
    float min, max;  ///< range of the values over all channels
};

/// Draws a map as a square image. Integers are shown unscaled. Floats are scaled by their largest
/// magnitude m: black to white is [-m, m] if some are negative, else [0, m]. One channel is shown
/// as grey; a fourth is ignored.
/// \param side  side of the image in pixels; pixels are means of texels, or texels are repeated
MapPreview preview_of(const MapImage& map, int side);

}  // namespace pelagic::tools
