// RGBA images composed of rectangles, images and text.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

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

}  // namespace pelagic::tools
