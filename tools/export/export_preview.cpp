#include "pelagic/tools/export/export_preview.hpp"

#include <stb/stb_easy_font.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/message/number_text.hpp"
#include "pelagic/message/one_line.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/simd/half_float.hpp"
#include "pelagic/tools/encode/image_codec.hpp"
#include "pelagic/tools/export/export_summary.hpp"
#include "pelagic/tools/export/image_files.hpp"
#include "pelagic/tools/export/mesh_files.hpp"
#include "pelagic/tools/export/sequence_output.hpp"
#include "pelagic/tools/maps/map_image.hpp"
#include "pelagic/tools/text/path_text.hpp"

namespace pelagic::tools {
namespace {

using Colour = std::array<std::uint8_t, 3>;

class RgbaImage {
   public:
    RgbaImage(int width, int height, Colour background);

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

RgbaImage::RgbaImage(int width, int height, Colour background)
    : width_(width),
      height_(height),
      pixels_(4 * static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 255) {
    fill(0, 0, width, height, background);
}

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

/// Draws a map as a square image. Integers are shown unscaled. Floats are scaled by their largest
/// magnitude m: black to white is [-m, m] if some are negative, else [0, m]. One channel is shown
/// as grey; a fourth is ignored.
/// \param side  side of the image in pixels; pixels are means of texels, or texels are repeated
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

// Layout of the sheet, in pixels.
constexpr int cells_per_row = 4, cell_side = 444, margin = 24, line_height = 28;
constexpr int sheet_width = cells_per_row * (cell_side + margin) + margin;
constexpr int small_text = 2, large_text = 4;
constexpr Colour paper = {24, 28, 32}, ink = {232, 236, 240}, pale_ink = {150, 160, 170};

/// Returns "8.61 MB".
std::string bytes_text(double bytes) {
    const std::vector<std::string> units = {"bytes", "kB", "MB", "GB", "TB"};
    std::size_t unit = 0;
    for (; bytes >= 1000 && unit + 1 < units.size(); ++unit) bytes /= 1000;
    return rounded_text(bytes, 3) + " " + units[unit];
}

/// Expected size of the export.
struct Expected {
    std::size_t files = 0;  ///< including sea.json and the record
    double bytes = 0, bytes_per_frame = 0;
};

/// Estimates the size of the export from one frame.
Expected expected_of(const ExportOptions& options, const Frame& frame) {
    Expected expected;
    const int number = options.times.number(0);
    const std::vector<ImageFile> images = image_files(options, number);
    for (const ImageFile& image : images)
        expected.bytes_per_frame += static_cast<double>(encode_image_file(image, frame, number, options).size());
    const double image_bytes = expected.bytes_per_frame;
    const std::vector<MeshFile> meshes = mesh_files(options, number);
    for (const MeshFile& mesh : meshes)
        expected.bytes_per_frame +=
            static_cast<double>(encode_mesh_file(mesh.format, exported_mesh(frame, options)).size());
    expected.files = (images.size() + meshes.size()) * options.times.count() + 2 + (options.events ? 1 : 0);
    if (options.flipbook) {
        expected.files += options.maps.maps.size() * frame.cascades.size() + 1;
        expected.bytes_per_frame += image_bytes;
    }
    for (const auto& sequence : mesh_sequences(options)) {
        sequence->add(0, frame);
        for (const SequenceOutput::File& file : sequence->finish()) {
            expected.bytes_per_frame += static_cast<double>(file.bytes.size());
            ++expected.files;
        }
    }
    expected.bytes = expected.bytes_per_frame * static_cast<double>(options.times.count());
    return expected;
}

std::string sample_text(Sample sample) {
    switch (sample) {
        case Sample::uint8: return "8 bits";
        case Sample::uint16: return "16 bits";
        case Sample::half: return "16-bit floats";
        case Sample::float32: return "32-bit floats";
    }
    return "";
}

std::string times_text(const FrameTimes& times) {
    const std::size_t count = times.count();
    std::string text = number_text(count) + (count == 1 ? " frame at " : " frames from ") +
                       rounded_text(times.time_of(times.number(0)), 4) + " s";
    if (count > 1) text += " to " + rounded_text(times.time_of(times.number(count - 1)), 4) + " s";
    if (!times.fps) text += ", a loop of " + rounded_text(times.loop_period_s, 4) + " s";
    return text;
}

std::string expected_text(const Expected& expected) {
    return number_text(expected.files) + " files, about " + bytes_text(expected.bytes) + ": " +
           bytes_text(expected.bytes_per_frame) + " a frame";
}

/// An image of a map of a cascade, with the lines of text below it.
struct Cell {
    RgbaImage image;
    std::vector<std::string> texts;
};

Cell cell_of(const ImageFile& file, const ImagePart& part, const Frame& frame, const MapOptions& options) {
    const bool is_patch = part.map == MapKind::foam && options.foam_patch;
    const MapImage map =
        is_patch ? foam_patch_image(frame, options) : map_image(frame, part.cascade, part.map, 0, options);
    const double side_m =
        is_patch ? options.foam_patch->side_m : frame.cascades[static_cast<std::size_t>(part.cascade)].grid.side_m;
    MapPreview shown = preview_of(map, cell_side);
    const std::string side = number_text(map.side), channels = map.channels == 1 ? " channel of " : " channels of ";
    Cell result{std::move(shown.image),
                {file.name, rounded_text(side_m, 3) + " m, " + side + " x " + side,
                 number_text(map.channels) + channels + sample_text(map.sample)}};
    if (is_floating(map.sample))
        result.texts.push_back(rounded_text(static_cast<double>(shown.min), 3) + " to " +
                               rounded_text(static_cast<double>(shown.max), 3));
    return result;
}

/// Returns the cells in the order of maps, each with the coarsest cascade first.
std::vector<Cell> cells_of(const ExportOptions& options, const Frame& frame) {
    const std::vector<ImageFile> files = image_files(options, options.times.number(0));
    std::vector<Cell> cells;
    for (const MapKind map : options.maps.maps)
        for (const ImageFile& file : files)
            for (const ImagePart& part : file.parts)
                if (part.map == map && part.first_level == 0)
                    cells.push_back(cell_of(file, part, frame, options.maps));
    return cells;
}

RgbaImage sheet_of(const std::vector<std::string>& titles, const std::vector<Cell>& cells) {
    constexpr int texts_height = 4 * line_height + margin;
    const int head = margin + 2 * line_height + static_cast<int>(titles.size() - 1) * line_height;
    const int rows = (static_cast<int>(cells.size()) + cells_per_row - 1) / cells_per_row;
    RgbaImage sheet(sheet_width, head + rows * (cell_side + texts_height), paper);
    int y = margin;
    for (const std::string& title : titles) {
        const bool is_first = &title == &titles.front();
        sheet.write(margin, y, title, is_first ? ink : pale_ink, is_first ? large_text : small_text);
        y += is_first ? 2 * line_height : line_height;
    }
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const int row = static_cast<int>(i) / cells_per_row, column = static_cast<int>(i) % cells_per_row;
        const int left = margin + column * (cell_side + margin);
        const int top = head + row * (cell_side + texts_height);
        sheet.paste(left, top, cells[i].image);
        int text_top = top + cell_side + line_height / 2;
        for (const std::string& text : cells[i].texts) {
            const bool is_name = &text == &cells[i].texts.front();
            sheet.write(left, text_top, text, is_name ? ink : pale_ink, small_text);
            text_top += line_height;
        }
    }
    return sheet;
}

}  // namespace

void preview_export(const ExportOptions& options, const OutputFolder& folder) {
    const OceanOptions how = ocean_options(options, nullptr);
    Ocean ocean(forecast_of(options.sea), how);
    const std::unique_ptr<EventPlayer> player = event_player(options, how);
    const Frame frame = exported_frame(ocean.frame_at(options.times.time_of(options.times.number(0))), player.get());
    const std::string expected = expected_text(expected_of(options, frame));
    const std::string sea = "Hs " + rounded_text(measured_significant_wave_height_m(frame), 3) + " m, peak period " +
                            peak_period_text(expected_waves(options.sea.sea).peak_period_s,
                                             options.sea.sea.loop_period_s, 2);
    const RgbaImage sheet = sheet_of({sea, times_text(options.times), expected}, cells_of(options, frame));
    const std::vector<unsigned char> png = encode_png(sheet.pixels(), sheet.width(), sheet.height());
    folder.write(preview_name, std::as_bytes(std::span(png)));
    std::printf("%s: the maps of the first frame, %s\nThe export will have %s. Nothing of it was written.\n",
                escaped((folder.path() / preview_name).string()).c_str(), sea.c_str(), expected.c_str());
}

}  // namespace pelagic::tools
