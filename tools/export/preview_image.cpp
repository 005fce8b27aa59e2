#include "pelagic/tools/export/preview_image.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <utility>

#include <stb/stb_easy_font.h>

#include "pelagic/simd/half_float.hpp"

namespace pelagic::tools {
namespace {

template <class Stored>
Stored stored_at(const MapImage& map, std::size_t index) {
    Stored stored;
    std::memcpy(&stored, &map.pixels[index * sizeof(Stored)], sizeof(Stored));
    return stored;
}

float value_at(const MapImage& map, std::size_t index) {
    switch (map.sample) {
        case Sample::uint8: return static_cast<float>(stored_at<std::uint8_t>(map, index)) / 255;
        case Sample::uint16: return static_cast<float>(stored_at<std::uint16_t>(map, index)) / 65535;
        case Sample::half: return float_of_half(stored_at<std::uint16_t>(map, index));
        case Sample::float32: return stored_at<float>(map, index);
    }
    return 0;
}

/// The texels of a pixel of the image, at least one.
struct Span {
    std::size_t begin, end;
};
Span texels_of(int pixel, int pixels, int texels) {
    const auto begin =
        static_cast<std::size_t>(pixel) * static_cast<std::size_t>(texels) / static_cast<std::size_t>(pixels);
    const auto end =
        static_cast<std::size_t>(pixel + 1) * static_cast<std::size_t>(texels) / static_cast<std::size_t>(pixels);
    return {begin, std::max(end, begin + 1)};
}

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

MapPreview preview_of(const MapImage& map, int side) {
    const auto n = static_cast<std::size_t>(map.side), channels = static_cast<std::size_t>(map.channels);
    MapPreview result{RgbaImage(side, side, Colour{0, 0, 0}), value_at(map, 0), value_at(map, 0)};
    for (std::size_t i = 1; i < n * n * channels; ++i) {
        const float value = value_at(map, i);
        result.min = std::min(result.min, value);
        result.max = std::max(result.max, value);
    }
    const bool is_signed = is_floating(map.sample) && result.min < 0;
    const float range = is_floating(map.sample) ? std::max({-result.min, result.max, 1e-30f}) : 1.f;
    const auto shade = [&](float value) {
        const float fraction = is_signed ? 0.5f + 0.5f * value / range : value / range;
        return static_cast<std::uint8_t>(std::clamp(255 * fraction + 0.5f, 0.f, 255.f));
    };
    for (int y = 0; y < side; ++y)
        for (int x = 0; x < side; ++x) {
            const Span rows = texels_of(y, side, map.side), columns = texels_of(x, side, map.side);
            std::array<float, 3> sum{};
            for (std::size_t row = rows.begin; row < rows.end; ++row)
                for (std::size_t column = columns.begin; column < columns.end; ++column)
                    for (std::size_t channel = 0; channel < std::min<std::size_t>(channels, 3); ++channel)
                        sum[channel] += value_at(map, (row * n + column) * channels + channel);
            const auto count = static_cast<float>((rows.end - rows.begin) * (columns.end - columns.begin));
            Colour colour;
            for (std::size_t channel = 0; channel < 3; ++channel)
                colour[channel] = shade(sum[channels == 1 ? 0 : channel] / count);
            if (channels == 2) colour[2] = shade(0);
            result.image.fill(x, y, 1, 1, colour);
        }
    return result;
}

}  // namespace pelagic::tools
