// An image for people that is put together of parts.
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
    /// \param rgba  the upper row first
    RgbaImage(int width, int height, std::vector<std::uint8_t> rgba);

    int width() const { return width_; }
    int height() const { return height_; }
    /// RGBA8, the upper row first.
    const std::vector<std::uint8_t>& pixels() const { return pixels_; }

    /// What is beyond an edge is left out.
    void fill(int left, int top, int width, int height, Colour colour);
    void paste(int left, int top, const RgbaImage& other);

    /// One line of ASCII in letters of 7 x 12 dots; others become "?". \param dot  pixels of a dot along each axis
    void write(int left, int top, const std::string& text, Colour colour, int dot);

   private:
    int width_, height_;
    std::vector<std::uint8_t> pixels_;
};

}  // namespace pelagic::tools
