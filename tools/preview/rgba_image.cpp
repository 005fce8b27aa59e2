#include "pelagic/tools/preview/rgba_image.hpp"

#include <algorithm>
#include <cstddef>
#include <utility>

#include <stb/stb_easy_font.h>

namespace pelagic::tools {
namespace {

std::string printable(std::string text) {
    for (char& letter : text)
        if (letter < ' ' || letter > '~') letter = '?';
    return text;
}

}  // namespace

RgbaImage::RgbaImage(int width, int height, Colour background)
    : width_(width),
      height_(height),
      pixels_(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255) {
    fill(0, 0, width, height, background);
}

RgbaImage::RgbaImage(int width, int height, std::vector<std::uint8_t> rgba)
    : width_(width), height_(height), pixels_(std::move(rgba)) {}

void RgbaImage::fill(int left, int top, int width, int height, Colour colour) {
    for (int y = std::max(top, 0); y < std::min(top + height, height_); ++y)
        for (int x = std::max(left, 0); x < std::min(left + width, width_); ++x)
            std::copy(colour.begin(), colour.end(),
                      pixels_.begin() + 4 * (static_cast<std::ptrdiff_t>(y) * width_ + x));
}

void RgbaImage::paste(int left, int top, const RgbaImage& other) {
    for (int y = std::max(top, 0); y < std::min(top + other.height_, height_); ++y)
        for (int x = std::max(left, 0); x < std::min(left + other.width_, width_); ++x)
            std::copy_n(
                other.pixels_.begin() + 4 * (static_cast<std::ptrdiff_t>(y - top) * other.width_ + (x - left)), 4,
                pixels_.begin() + 4 * (static_cast<std::ptrdiff_t>(y) * width_ + x));
}

void RgbaImage::write(int left, int top, const std::string& text, Colour colour, int dot) {
    struct Corner {
        float x, y, z;
        std::array<unsigned char, 4> colour;
    };
    struct Bar {
        std::array<Corner, 4> corners;
    };
    std::string letters = printable(text);
    // According to stb's documentation a letter needs 270 bytes on average, about four bars.
    std::vector<Bar> bars(letters.size() * 20);
    const int count =
        stb_easy_font_print(0, 0, letters.data(), nullptr, bars.data(), static_cast<int>(bars.size() * sizeof(Bar)));
    for (int i = 0; i < count; ++i) {
        const Corner &first = bars[static_cast<std::size_t>(i)].corners[0],
                     &last = bars[static_cast<std::size_t>(i)].corners[2];
        const auto pixels = [dot](float dots) { return static_cast<int>(dots) * dot; };
        fill(left + pixels(first.x), top + pixels(first.y), pixels(last.x - first.x), pixels(last.y - first.y),
             colour);
    }
}

}  // namespace pelagic::tools
