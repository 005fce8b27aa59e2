#include "pelagic/tools/export/export_preview.hpp"

#include <algorithm>
#include <cstdio>
#include <span>
#include <string>
#include <vector>

#include "pelagic/message/number_text.hpp"
#include "pelagic/message/one_line.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/encode/encode_image.hpp"
#include "pelagic/tools/events/event_player.hpp"
#include "pelagic/tools/export/export_summary.hpp"
#include "pelagic/tools/export/image_files.hpp"
#include "pelagic/tools/export/mesh_files.hpp"
#include "pelagic/tools/export/mesh_sequences.hpp"
#include "pelagic/tools/preview/film.hpp"
#include "pelagic/tools/preview/map_preview.hpp"
#include "pelagic/tools/preview/rgba_image.hpp"
#include "pelagic/tools/preview/shaded_sea.hpp"
#include "pelagic/tools/text/progress.hpp"
#include "pelagic/tools/text/stop_signal.hpp"

namespace pelagic::tools {
namespace {

// Limits of the film: long enough to show the motion, about ten seconds to make on two cores.
constexpr std::size_t max_film_frames = 96;
constexpr int film_width = 640, film_height = 360;
/// Frames of the strip, in two columns.
constexpr std::size_t strip_frames = 8, strip_columns = 2;

// Layout of the sheet, in pixels.
constexpr int cells_a_row = 4, cell_side = 444, margin = 24, line_height = 28;
constexpr int sheet_width = cells_a_row * (cell_side + margin) + margin, still_height = 660;
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
    double bytes = 0, bytes_a_frame = 0;
};

/// Estimates the size of the export from one frame.
Expected expected_of(const ExportOptions& options, const Frame& frame) {
    Expected expected;
    const int number = options.times.number(0);
    const std::vector<ImageFile> images = image_files(options, number);
    for (const ImageFile& image : images)
        expected.bytes_a_frame += static_cast<double>(encode_image_file(image, frame, number, options).size());
    const double image_bytes = expected.bytes_a_frame;
    const std::vector<MeshFile> meshes = mesh_files(options, number);
    for (const MeshFile& mesh : meshes)
        expected.bytes_a_frame +=
            static_cast<double>(encode_mesh_file(mesh.format, exported_mesh(frame, options)).size());
    expected.files = (images.size() + meshes.size()) * options.times.count() + 2 + (options.events ? 1 : 0);
    if (options.flipbook) {
        expected.files += options.maps.maps.size() * frame.cascades.size() + 1;
        expected.bytes_a_frame += image_bytes;
    }
    for (const auto& sequence : mesh_sequences(options)) {
        sequence->add(0, frame);
        for (const SequenceOutput::File& file : sequence->finish()) {
            expected.bytes_a_frame += static_cast<double>(file.bytes.size());
            ++expected.files;
        }
    }
    expected.bytes = expected.bytes_a_frame * static_cast<double>(options.times.count());
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
           bytes_text(expected.bytes_a_frame) + " a frame";
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

RgbaImage sheet_of(const std::vector<std::string>& titles, const RgbaImage& still, const std::vector<Cell>& cells) {
    constexpr int texts_height = 4 * line_height + margin;
    const int head = margin + 2 * line_height + static_cast<int>(titles.size() - 1) * line_height;
    const int rows = (static_cast<int>(cells.size()) + cells_a_row - 1) / cells_a_row;
    RgbaImage sheet(sheet_width, head + still.height() + margin + rows * (cell_side + texts_height), paper);
    int y = margin;
    for (const std::string& title : titles) {
        const bool is_first = &title == &titles.front();
        sheet.write(margin, y, title, is_first ? ink : pale_ink, is_first ? large_text : small_text);
        y += is_first ? 2 * line_height : line_height;
    }
    sheet.paste(margin, head, still);
    for (std::size_t i = 0; i < cells.size(); ++i) {
        const int row = static_cast<int>(i) / cells_a_row, column = static_cast<int>(i) % cells_a_row;
        const int left = margin + column * (cell_side + margin);
        const int top = head + still.height() + margin + row * (cell_side + texts_height);
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

RgbaImage preview_of(const ShadedSea& shaded, const std::vector<std::uint8_t>& rgba) {
    return {shaded.width(), shaded.height(), rgba};
}

RgbaImage strip_of(const std::vector<RgbaImage>& images) {
    const auto rows = static_cast<int>((images.size() + strip_columns - 1) / strip_columns);
    const auto columns = static_cast<int>(std::min(strip_columns, images.size()));
    RgbaImage strip(columns * film_width, rows * film_height, paper);
    for (std::size_t i = 0; i < images.size(); ++i)
        strip.paste(static_cast<int>(i % strip_columns) * film_width,
                    static_cast<int>(i / strip_columns) * film_height, images[i]);
    return strip;
}

void write_bytes(const OutputFolder& folder, const char* name, const std::vector<unsigned char>& bytes) {
    folder.write(name, std::as_bytes(std::span(bytes)));
}

void write_preview_png(const OutputFolder& folder, const char* name, const RgbaImage& image) {
    write_bytes(folder, name, encode_png(image.pixels(), image.width(), image.height()));
}

/// Renders the first frames of the export as a film, or some of them as a strip.
class FilmMaker {
   public:
    FilmMaker(const ExportOptions& options, Ocean& ocean, const std::shared_ptr<Executor>& executor)
        : times_(options.times),
          ocean_(ocean),
          shaded_(options.sea.sea, film_width, film_height, executor),
          frames_(std::min(times_.count(), max_film_frames)) {}

    /// Writes the film or the strip. Returns a line that describes the file.
    std::string write_to(const OutputFolder& folder) {
        const double fps = times_.fps.value_or(static_cast<double>(times_.count()) / times_.loop_period_s);
        std::optional<Film> film;
        if (can_make_films()) film.emplace(film_width, film_height, fps);
        std::vector<RgbaImage> strip;
        Progress progress("frame of the film", frames_);
        const std::size_t step = std::max<std::size_t>(1, frames_ / strip_frames);
        for (std::size_t i = 0; i < frames_; ++i) {
            const bool is_in_strip = i % step == 0 && strip.size() < strip_frames;
            if (!film && !is_in_strip) continue;
            if (stop_signal() != 0) throw Stopped{stop_signal(), static_cast<int>(i), static_cast<int>(frames_)};
            progress.show(i);
            const std::vector<std::uint8_t>& pixels = shaded_.draw(ocean_.frame_at(times_.time_of(times_.number(i))));
            if (is_in_strip) strip.push_back(preview_of(shaded_, pixels));
            if (film) film->add(pixels);
        }
        const std::string what = number_text(frames_) + " of " + number_text(times_.count()) + " frames";
        const Film::Encoded encoded = film ? film->finish() : Film::Encoded{{}, "ffmpeg is not in PATH"};
        if (!encoded.mp4.empty()) {
            write_bytes(folder, preview_film_name, encoded.mp4);
            folder.remove(preview_strip_name);
            return (folder.path() / preview_film_name).string() + ": " + what + ", " + rounded_text(fps, 4) +
                   " a second";
        }
        write_preview_png(folder, preview_strip_name, strip_of(strip));
        folder.remove(preview_film_name);
        return (folder.path() / preview_strip_name).string() + ": " + number_text(strip.size()) + " of the first " +
               what + ", and no film: " + encoded.reason;
    }

   private:
    const FrameTimes& times_;
    Ocean& ocean_;
    ShadedSea shaded_;
    std::size_t frames_;
};

}  // namespace

void preview_export(const ExportOptions& options, OceanOptions how, const OutputFolder& folder) {
    how.slopes = how.foam = true;  // for the image of the sea
    Ocean ocean(forecast_of(options.sea), how);
    const double first_s = options.times.time_of(options.times.number(0));
    Frame frame = ocean.frame_at(first_s);
    std::optional<EventPlayer> player;
    if (options.events) frame.dynamic_waves = player.emplace(*options.events, how.executor, how.isa).at(first_s);
    const Expected expected = expected_of(options, frame);
    const std::string sea = "Hs " + rounded_text(measured_significant_wave_height_m(frame), 3) + " m, peak period " +
                            peak_period_text(expected_waves(options.sea.sea).peak_period_s,
                                             options.sea.sea.loop_period_s, 2);
    ShadedSea still(options.sea.sea, sheet_width - 2 * margin, still_height, how.executor);
    const RgbaImage image = preview_of(still, still.draw(frame));
    write_preview_png(
        folder, preview_sheet_name,
        sheet_of({sea, times_text(options.times), expected_text(expected)}, image, cells_of(options, frame)));
    const std::string film = FilmMaker(options, ocean, how.executor).write_to(folder);
    std::printf("%s: the maps of the first frame, %s\n%s\nThe export will have %s. Nothing of it was written.\n",
                escaped((folder.path() / preview_sheet_name).string()).c_str(), sea.c_str(), film.c_str(),
                expected_text(expected).c_str());
}

}  // namespace pelagic::tools
