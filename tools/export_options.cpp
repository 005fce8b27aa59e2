#include "pelagic/tools/export_options.hpp"

#include <algorithm>
#include <array>
#include <cstdlib>
#include <stdexcept>
#include <vector>

#include "pelagic/tools/errors.hpp"
#include "pelagic/tools/export_names.hpp"
#include "pelagic/tools/image_codec.hpp"
#include "pelagic/tools/option_text.hpp"
#include "pelagic/tools/pixel_meaning.hpp"

namespace pelagic::tools {
namespace {

constexpr int most_frames = 1'000'000;
constexpr double latest_start_s = 1e9;
constexpr double most_fps = 1000;
constexpr double default_fps = 24;

std::vector<std::string> names_of_isas_here() {
    std::vector<std::string> names;
    for (const Isa isa : isas_here()) names.emplace_back(name_of(isa));
    return names;
}

void choose_maps(ExportOptions& options, const std::string& text) {
    const std::map<std::string, bool*> all = {
        {"displacement", &options.displacement}, {"gradient", &options.gradient}, {"foam", &options.foam}};
    for (const auto& [name, chosen] : all) *chosen = false;
    for (const std::string& map : split_at_commas(text)) {
        const auto found = all.find(map);
        if (found == all.end() || *found->second)
            throw bad_value("--maps", text, "displacement, gradient, foam or some of them with commas, each once");
        *found->second = true;
    }
}

/// "wave.%04d.exr" or "wave.png": what other programs take, and what nobody would call a folder.
bool is_picture_name(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    constexpr std::array pictures = {".exr", ".png", ".tif", ".tiff", ".jpg", ".jpeg"};
    return path.filename().string().find('%') != std::string::npos ||
           std::find(pictures.begin(), pictures.end(), extension) != pictures.end();
}

// A folder may be missing; what is there must be one.
std::filesystem::path checked_folder(const std::optional<std::string>& text) {
    if (!text || text->empty()) throw InputError("--out is missing, needs a folder to write to");
    std::error_code error;
    std::filesystem::path path = *text;
    if (!std::filesystem::is_directory(path, error) && is_picture_name(path))
        throw bad_value("--out", *text, "a folder: the files in it are named displacement_0000.exr and so on");
    for (std::filesystem::path up = path; !up.empty(); up = up.parent_path()) {
        const auto status = std::filesystem::status(up, error);
        if (std::filesystem::exists(status) && !std::filesystem::is_directory(status))
            throw bad_value("--out", *text, "a folder, but " + up.string() + " is a file");
        if (!up.has_relative_path()) break;
    }
    return path;
}

// The finished trace is renamed to its name, so it would take the place of a device, or of a file of the export.
std::filesystem::path checked_trace(const std::string& text, const std::filesystem::path& folder) {
    if (text.empty()) throw InputError("--trace is empty, needs a file to write to");
    const std::filesystem::path path = text;
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (std::filesystem::is_directory(status) || path.filename().empty())
        throw bad_value("--trace", text, "a file, but that is a folder");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        throw bad_value("--trace", text, "a file, but that is a device or the like");
    const auto place_of = [&](const std::filesystem::path& file) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(file), error);
    };
    if (is_export_name(path.filename().string()) && place_of(path) == place_of(folder / path.filename()))
        throw bad_value("--trace", text, "another name, since the export uses that one itself");
    return path;
}

}  // namespace

void ComputeFlags::add_to(CLI::App& app) {
    app.add_option("--threads", threads_, "most threads to use; 0 to 1024, default 0: all cores")
        ->type_name("NUMBER")
        ->group("Computing (the same bits whatever you choose)");
    const std::vector<std::string> isas = names_of_isas_here();
    app.add_option("--isa", isa_, "instruction set: " + list_of(isas) + " here; default the strongest")
        ->type_name("NAME")
        ->group("Computing (the same bits whatever you choose)");
}

ComputeOptions ComputeFlags::resolve() const {
    ComputeOptions options;
    if (threads_) options.threads = whole_number_in("--threads", *threads_, 0, 1024);
    if (isa_) {
        options.isa = isa_named(*isa_);
        const std::vector<std::string> here = names_of_isas_here();
        if (!options.isa || !runs_here(*options.isa)) throw bad_value("--isa", *isa_, list_of(here) + " on this CPU");
    }
    try {
        options.isa = choose_isa(options.isa);
    } catch (const std::invalid_argument& error) {
        throw InputError(error.what());
    }
    return options;
}

bool ComputeFlags::names_isa() const {
    const char* const wish = std::getenv("PELAGIC_ISA");
    return isa_ || (wish && *wish);
}

void ExportFlags::add_to(CLI::App& app) {
    const auto add = [&](const std::string& flag, const std::string& type, const std::string& help) {
        app.add_option("--" + flag, typed_[flag], help)->type_name(type);
    };
    add("out", "DIR", "folder for the files; made if missing, an earlier export in it is replaced");
    add("start", "SECONDS", "time of the first frame; default 0");
    add("frames", "NUMBER", "how many frames; 1 to 1000000, default 1");
    add("fps", "NUMBER", "frames a second; (0, 1000], default 24");
    add("loop-frames", "NUMBER", "that many frames over exactly one loop period, instead of --frames and --fps");
    add("maps", "NAMES",
        "displacement, gradient, foam, or some of them with commas; default displacement,gradient. Foam lasts: it "
        "costs a "
        "tick, less than a frame, for each tenth of a second between frames, 29 at most");
    add("format", "NAME", "exr (displacement as EXR, the others as PNG) or tif (all as TIFF); default exr");
    app.add_flag("--mips", mips_, "every level of gradient and foam, down to one texel");
    app.add_flag("--half", half_, "displacement as 16-bit instead of 32-bit floats");
    app.add_flag("--resume", resume_, "keep the frames of an interrupted export that are whole, make the rest");
    app.add_flag("--no-sync", no_sync_,
                 "don't wait for the disk: faster, but a power cut may cost frames that are done");
    app.add_flag("--no-lock", no_lock_,
                 "for file systems without locks; see to it that no other export uses the folder");
    add("trace", "FILE", "Chrome trace of stages and workers, opens in ui.perfetto.dev; where the time goes");
    sea_.add_to(app);
    sea_.add_weather_to(app);
    compute_.add_to(app);
    app.footer(pixel_meaning());
}

ExportOptions ExportFlags::resolve() const {
    ExportOptions options;
    options.folder = checked_folder(typed_.at("out"));
    options.sea = sea_.resolve();
    options.compute = compute_.resolve();
    options.mips = mips_;
    options.half = half_;
    options.resume = resume_;
    options.sync = !no_sync_;
    options.lock = !no_lock_;

    if (const auto& start = typed_.at("start"))
        options.start_s = number_in("--start", *start, -latest_start_s, latest_start_s, "seconds in [-1e9, 1e9]");
    const auto& loop_frames = typed_.at("loop-frames");
    for (const std::string other : {"frames", "fps"})
        if (loop_frames && typed_.at(other))
            throw InputError("--loop-frames is " + *loop_frames + " and --" + other + " is " + *typed_.at(other) +
                             ", needs one of the two: a loop's frames follow from its period");
    if (loop_frames && !options.sea.changes.empty())
        throw InputError("--loop-frames is " + *loop_frames +
                         ", needs --frames and --fps with --weather: it is no loop");
    if (loop_frames) {
        options.frames = whole_number_in("--loop-frames", *loop_frames, 1, most_frames);
    } else {
        options.fps = default_fps;
        if (const auto& frames = typed_.at("frames"))
            options.frames = whole_number_in("--frames", *frames, 1, most_frames);
        if (const auto& fps = typed_.at("fps")) {
            options.fps = parse_number(*fps);
            if (!options.fps || *options.fps <= 0 || *options.fps > most_fps)
                throw bad_value("--fps", *fps, "(0, 1000]");
        }
    }
    if (const auto& maps = typed_.at("maps")) choose_maps(options, *maps);
    if (const auto& format = typed_.at("format")) {
        if (*format != "exr" && *format != "tif") throw bad_value("--format", *format, "exr or tif");
        if (*format == "tif") options.format = ImageFormat::tiff;
    }
    if (const auto& trace = typed_.at("trace")) options.trace = checked_trace(*trace, options.folder);
    image_codec();  // before anything is written: without its library nothing will be
    return options;
}

}  // namespace pelagic::tools
