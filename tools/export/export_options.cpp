#include "pelagic/tools/export/export_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "pelagic/tools/export/export_names.hpp"
#include "pelagic/tools/export/image_files.hpp"
#include "pelagic/tools/export/sequence_output.hpp"
#include "pelagic/tools/files/open_file.hpp"
#include "pelagic/tools/files/zstd.hpp"
#include "pelagic/tools/maps/pixel_meaning.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"
#include "pelagic/tools/text/path_text.hpp"

namespace pelagic::tools {
namespace {

constexpr int max_export_frames = 1'000'000;
constexpr double latest_start_s = 1e9;
constexpr double max_fps = 1000;
constexpr double default_fps = 24;
constexpr const char* one_loop = "loop";
constexpr const char* no_maps = "none";

/// Returns "displacement, gradient, foam".
std::string names_of_maps() {
    std::string names;
    for (const MapKind map : all_maps) names.append(names.empty() ? "" : ", ").append(name_of(map));
    return names;
}

std::vector<MapKind> maps_in(const std::string& text) {
    std::vector<MapKind> maps;
    if (text == no_maps) return maps;
    for (const std::string& name : split_at_commas(text)) {
        const auto map = cascade_map_named(name);
        if (!map || std::find(maps.begin(), maps.end(), *map) != maps.end())
            throw bad_value("--maps", text, names_of_maps() + " or some of them with commas, each once, or none");
        maps.push_back(*map);
    }
    std::sort(maps.begin(), maps.end());
    return maps;
}

/// Returns what --compression accepts for a format.
std::span<const Compression> compressions_of(ImageFormat format) {
    using enum Compression;
    static constexpr std::array exr = {zip, zips, piz, dwaa, none};
    static constexpr std::array tiff = {zip, lzw, none};
    static constexpr std::array ktx2 = {zstd, none};
    static constexpr std::array dds = {none};
    switch (format) {
        case ImageFormat::exr_and_png: return exr;
        case ImageFormat::tiff: return tiff;
        case ImageFormat::ktx2: return ktx2;
        case ImageFormat::dds: return dds;
    }
    return {};
}

/// Returns the compression with this name. Throws InputError if the format does not support it.
Compression compression_in(ImageFormat format, const std::string& text) {
    const std::string option = "--compression";
    const std::span<const Compression> supported = compressions_of(format);
    const auto compression = value_named<Compression>(text);
    if (!compression || std::find(supported.begin(), supported.end(), *compression) == supported.end()) {
        std::vector<std::string_view> names;
        for (const Compression one : supported) names.push_back(name_of(one));
        throw unknown_name(option, text, names);
    }
    if (*compression == Compression::zstd && !has_zstd())
        throw bad_value(option, text, "a pelagic that was built with libzstd");
    return *compression;
}

/// Throws InputError if options for EXR files apply to no file, or EXR does not support them.
void check_exr(const MapOptions& options) {
    const bool has_exr =
        std::any_of(options.maps.begin(), options.maps.end(), [&](MapKind map) { return options.is_exr(map); });
    if (options.pack != Pack::files && options.format != ImageFormat::exr_and_png)
        throw bad_value("--pack", name_of(options.pack), "--format exr: other files have one map");
    if (options.pack != Pack::files && options.bit_depth == BitDepth::bits_16)
        throw bad_value("--bit-depth", "16", "8 or float with --pack: EXR has no 16-bit whole numbers");
    if (options.tiled && !has_exr) throw InputError("--tiled needs a map in an EXR file, and none is");
    if (options.compression != MapOptions().compression && !has_exr && options.format == ImageFormat::exr_and_png)
        throw bad_value("--compression", name_of(options.compression),
                        "a map in an EXR file, and none is: PNG has its own");
    if (options.pack != Pack::files && options.mips && !options.tiled)
        throw bad_value("--pack", name_of(options.pack),
                        "--tiled with --mips: levels within an EXR file are in tiles");
}

/// Throws InputError if --half or --mips applies to no file.
void check_applying(const MapOptions& options, bool has_dynamic_waves) {
    const auto any = [&](auto is) { return std::any_of(options.maps.begin(), options.maps.end(), is); };
    if (options.half && !has_dynamic_waves && !any([&](MapKind map) { return is_floating(options.sample_of(map)); }))
        throw InputError("--half requires a map of floats, and none is");
    const bool has_levels = is_texture(options.format) || options.tiled;
    const auto is_one_image = [&](MapKind map) { return map == MapKind::foam && options.foam_patch; };
    if (options.mips && !any([&](MapKind map) { return !is_one_image(map) && (has_levels || has_chain(map)); }))
        throw InputError("--mips requires a map with mip levels, and none has them");
}

/// Returns the range of `count` frames from `first` on. Throws InputError if the last number is too
/// large.
std::vector<FrameRange> one_run(int first, int count, const std::string& option, const std::string& text) {
    if (count - 1 > FrameTimes::largest_number - first)
        throw bad_value(option, text,
                        "at most " + number_text(FrameTimes::largest_number - first + 1) +
                            " frames from --start-number " + number_text(first) + " on");
    return {{first, first + count - 1}};
}

/// Returns the number of frames in a loop. Throws InputError unless it is a whole number.
int frames_of_a_loop(double loop_period_s, double fps) {
    const double frames = loop_period_s * fps, whole = std::round(frames);
    // The rounding error of the product is far smaller.
    if (std::fabs(frames - whole) > 1e-9 * frames || whole < 1 || whole > max_export_frames)
        throw InputError("--frames is loop, expected a loop of whole frames, 1 to 1000000: --loop-period " +
                         number_text(loop_period_s) + " at --fps " + number_text(fps) + " has " +
                         number_text(frames) + "; --loop-period " + number_text(std::max(whole, 1.0) / fps) +
                         " would do");
    return static_cast<int>(whole);
}

/// Returns true for names such as "wave.png", which are not meant as folders.
bool is_image_name(const std::filesystem::path& path) {
    const std::string extension = path.extension().string();
    constexpr std::array images = {".exr", ".png", ".tif", ".tiff", ".jpg", ".jpeg", ".ktx2", ".dds"};
    return std::find(images.begin(), images.end(), extension) != images.end();
}

struct OutputPlace {
    std::filesystem::path folder;
    std::optional<NamePattern> names;
};

/// Parses "8x4".
FlipbookGrid grid_in(const std::string& text) {
    const std::size_t cross = text.find('x');
    const auto columns = parse_integer(text.substr(0, cross));
    const auto rows = cross == std::string::npos ? std::nullopt : parse_integer(text.substr(cross + 1));
    if (!columns || !rows || std::min(*columns, *rows) < 1 || std::max(*columns, *rows) > largest_flipbook_side)
        throw bad_value("--flipbook", text, "columns and rows from 1 to 16384, as 8x4");
    return {static_cast<int>(*columns), static_cast<int>(*rows)};
}

// The folder may be missing, but no part of its path may be a file.
OutputPlace checked_place(const std::optional<std::string>& text) {
    if (!text || text->empty()) throw InputError("--out is missing: expected a folder to write to");
    constexpr const char* accepted = "a folder, or a name for a sequence such as wave.####.exr or wave.%04d.tif";
    std::error_code error;
    OutputPlace place{path_of(*text), {}};
    if (const std::filesystem::path path = path_of(*text); !std::filesystem::is_directory(any_length(path), error)) {
        if (NamePattern::is_meant(path.filename().string())) {
            place.names = NamePattern::parse(path.filename().string());
            if (!place.names) throw bad_value("--out", *text, accepted);
            place.folder = path.has_parent_path() ? path.parent_path() : path_of(".");
        } else if (is_image_name(path)) {
            throw bad_value("--out", *text, accepted);
        }
    }
    for (std::filesystem::path up = place.folder; !up.empty(); up = up.parent_path()) {
        const auto status = std::filesystem::status(any_length(up), error);
        if (std::filesystem::exists(status) && !std::filesystem::is_directory(status))
            throw bad_value("--out", *text, "a folder, but " + up.string() + " is a file");
        if (!up.has_relative_path()) break;
    }
    return place;
}

// The finished trace is renamed to its name, so it must not replace a device or a file of the
// export.
std::filesystem::path checked_trace(const std::string& text, const ExportOptions& options) {
    if (text.empty()) throw InputError("--trace is empty, expected a file to write to");
    const std::filesystem::path path = path_of(text);
    std::error_code error;
    const auto status = std::filesystem::status(any_length(path), error);
    if (std::filesystem::is_directory(status) || path.filename().empty())
        throw bad_value("--trace", text, "a file, but that is a folder");
    if (std::filesystem::exists(status) && !std::filesystem::is_regular_file(status))
        throw bad_value("--trace", text, "a file, but that is a device or the like");
    const auto canonical = [&](const std::filesystem::path& file) {
        return std::filesystem::weakly_canonical(std::filesystem::absolute(file), error);
    };
    if (is_export_name(path.filename().string(), options.maps.names) &&
        canonical(path) == canonical(options.folder / path.filename()))
        throw bad_value("--trace", text, "another name, since the export uses that one itself");
    return path;
}

}  // namespace

void ExportFlags::add_to(CLI::App& app) {
    const auto add = [&](const std::string& names, const std::string& type, const std::string& help) {
        app.add_option("--" + names, typed_[names.substr(0, names.find(','))], help)->type_name(type);
    };
    app.option_defaults()->group(help_group::output);
    add("out,-o,DIR", "DIR", "folder, created if missing; or names: DIR/wave.####.exr");
    app.add_flag("--resume", resume_, "keep the complete frames of an interrupted export");
    app.add_flag("--overwrite", overwrite_, "replace a finished export in the folder");
    app.add_flag("--preview", preview_, "write only preview.png, with the maps of the first frame");
    add("shard", "I/N", "export shard I of N; pelagic merge joins the shards");
    app.add_flag("--no-sync", no_sync_, "do not wait for the disk: a power failure may lose frames");
    app.add_flag("--no-lock", no_lock_, "do not lock the folder, for file systems without locks");
    add("trace", "FILE", "write a Chrome trace of stages and workers");

    app.option_defaults()->group(help_group::frames);
    add("frames", "NUMBERS", "1 to 1000000; a list as 10-20,40; or loop: one period (default: 1)");
    add("fps", "NUMBER", "frames per second; (0, 1000] (default: 24)");
    add("loop-frames", "NUMBER", "number of frames over one loop period; replaces --frames and --fps");
    add("start", "SECONDS", "time of the first frame; [-1e9, 1e9] (default: 0)");
    add("start-number", "NUMBER", "number of the first frame; 0 to 999999 (default: 0)");

    app.option_defaults()->group(help_group::maps);
    add("maps", "NAMES", names_of_maps() + ", separated by commas, or none (default: displacement,gradient)");
    add("format", "exr|tif|ktx2|dds",
        "exr: floats as EXR, others as PNG; tif: all as TIFF; ktx2 and dds: textures (default: exr)");
    add("bit-depth", alternatives(names_of<BitDepth>()),
        "bits of normal and foam (default: 16 of PNG and TIFF with normal, else 8)");
    app.add_flag("--half", half_, "write 16-bit instead of 32-bit floats");
    add("foam-size", "METRES", "side of the foam map of several cascades; [0.001, 1e6] (default: 200)");
    add("foam-pixels", "NUMBER", "pixels along its side; 1 to 8192 (default: 1024)");
    add("normal-y", alternatives(names_of<NormalY>()),
        "green of normals: OpenGL's up or DirectX's down (default: up)");
    add("axes", alternatives(names_of<UpAxis>()), "axes of maps and meshes; z-up: x east, y north (default: y-up)");
    add("unit", alternatives(names_of<LengthUnit>()), "unit of displacements, velocities and meshes (default: m)");
    add("rows", alternatives(names_of<FirstRow>()), "edge of the image with the row z = 0 (default: top)");
    app.add_flag("--mips", mips_, "write all mip levels; of displacement and velocity in textures only");
    add("compression", "NAME",
        "EXR: zip, zips, piz, dwaa (lossy) or none; TIFF: zip, lzw or none; KTX2: zstd or none "
        "(default: zip; textures: none)");
    add("pack", alternatives(names_of<Pack>()),
        "a file for each map and cascade, or one EXR file a frame with layers or parts (default: files)");
    app.add_flag("--tiled", tiled_, "write EXR files in tiles of 64 x 64 pixels, with --mips all levels");
    add("flipbook", "COLUMNSxROWS", "also write all frames side by side: flipbook_MAP and flipbook.json");
    app.add_flag_callback(
        "--help-pixels", [] { throw CLI::CallForVersion(pixel_meaning(), 0); },
        "print the meaning of pixel values, rows and axes, and exit");
    meshes_.add_to(app);
    events_.add_to(app);
    sea_.add_to(app);
    sea_.add_weather_to(app);
    water_frame_.add_to(app);
    compute_.add_to(app);
}

FrameTimes ExportFlags::times(const ResolvedSea& sea) const {
    FrameTimes times;
    times.loop_period_s = sea.sea.loop_period_s;
    if (const auto& start = typed("start"))
        times.start_s = number_in("--start", *start, -latest_start_s, latest_start_s, "seconds in [-1e9, 1e9]");
    if (const auto& number = typed("start-number"))
        times.start_number = whole_number_in("--start-number", *number, 0, FrameTimes::largest_number);
    times.ranges = {{times.start_number, times.start_number}};
    const auto& loop_frames = typed("loop-frames");
    const auto& frames = typed("frames");
    for (const std::string other : {"frames", "fps"})
        if (loop_frames && typed(other))
            throw InputError("--loop-frames is " + *loop_frames + " and --" + other + " is " + *typed(other) +
                             "; give one of the two: a loop's frames follow from its period");
    const bool is_loop = loop_frames || frames == one_loop;
    if (is_loop && !sea.changes.empty())
        throw InputError((loop_frames ? "--loop-frames is " + *loop_frames : "--frames is loop") +
                         ", expected a number of --frames with --weather: it is no loop");
    if (loop_frames) {
        times.ranges =
            one_run(times.start_number, whole_number_in("--loop-frames", *loop_frames, 1, max_export_frames),
                    "--loop-frames", *loop_frames);
        return times;
    }
    times.fps = default_fps;
    if (const auto& fps = typed("fps")) {
        times.fps = parse_number(*fps);
        if (!times.fps || *times.fps <= 0 || *times.fps > max_fps) throw bad_value("--fps", *fps, "(0, 1000]");
    }
    if (frames == one_loop) {
        times.ranges =
            one_run(times.start_number, frames_of_a_loop(times.loop_period_s, *times.fps), "--frames", *frames);
        times.fps.reset();
    } else if (frames && frames->find_first_of("-,", 1) != std::string::npos) {
        const auto ranges = parse_frame_ranges(*frames);
        if (!ranges)
            throw bad_value("--frames", *frames,
                            "a number of frames, or rising numbers from 0 to 999999 as 10-20,40");
        if (ranges->front().first < times.start_number)
            throw bad_value("--frames", *frames,
                            "numbers from --start-number, " + number_text(times.start_number) + ", on");
        times.ranges = *ranges;
    } else if (frames) {
        times.ranges = one_run(times.start_number, whole_number_in("--frames", *frames, 1, max_export_frames),
                               "--frames", *frames);
    }
    return times;
}

MapOptions ExportFlags::maps(const std::optional<NamePattern>& names) const {
    MapOptions options;
    options.names = names;
    options.mips = mips_;
    options.half = half_;
    if (const auto& maps = typed("maps")) options.maps = maps_in(*maps);
    const auto set = [&]<class Enum>(const std::string& flag, Enum& option) {
        if (const auto& text = typed(flag)) option = one_of<Enum>("--" + flag, *text);
    };
    set("bit-depth", options.bit_depth);
    set("normal-y", options.normal_y);
    set("axes", options.up_axis);
    set("unit", options.unit);
    set("rows", options.rows);
    set("pack", options.pack);
    if (options.bit_depth != BitDepth::bits_8 && !options.has(MapKind::normal) && !options.has(MapKind::foam))
        throw bad_value("--bit-depth", *typed("bit-depth"),
                        "normal or foam among --maps: the others have types of their own");
    if (options.normal_y != NormalY::up && !options.has(MapKind::normal))
        throw bad_value("--normal-y", *typed("normal-y"), "normal among --maps");
    const auto& typed_format = typed("format");
    if (typed_format) options.format = one_of<ImageFormat>("--format", *typed_format);
    if (names && !value_named<ImageFormat>(names->extension()))
        throw bad_value("--out", *typed("out"), "a name that ends with .exr, .tif, .ktx2 or .dds");
    if (names && typed_format && *typed_format != names->extension())
        throw InputError("--format is " + *typed_format + " and --out is " + *typed("out") +
                         ", expected the same format");
    if (names) options.format = *value_named<ImageFormat>(names->extension());
#if !defined(PELAGIC_HAS_TIFF)
    if (options.format == ImageFormat::tiff)
        throw InputError("tif files are not in this build, which lacks OpenImageIO; expected exr, ktx2 or dds");
#endif
    options.tiled = tiled_;
    const auto& compression = typed("compression");
    if (is_texture(options.format)) options.compression = Compression::none;
    if (compression) options.compression = compression_in(options.format, *compression);
    // A slope of 1/127, the step of 8 bits, shows as bands in reflections of calm water.
    if (!typed("bit-depth") && options.has(MapKind::normal) && options.pack == Pack::files &&
        !is_texture(options.format))
        options.bit_depth = BitDepth::bits_16;
    check_exr(options);
    return options;
}

FoamPatch ExportFlags::foam_patch() const {
    FoamPatch patch;
    if (const auto& size = typed("foam-size"))
        patch.side_m = number_in("--foam-size", *size, 0.001, 1e6, "metres in [0.001, 1e6]");
    if (const auto& pixels = typed("foam-pixels"))
        patch.pixels = whole_number_in("--foam-pixels", *pixels, 1, 8192);
    return patch;
}

ExportOptions ExportFlags::resolve() const {
    checked_place(typed("out"));  // report errors in --out before errors in the sea
    ExportOptions options = resolve_with(sea_.resolve());
    load_codecs(options);
    return options;
}

ExportOptions ExportFlags::resolve_with(const ResolvedSea& sea) const {
    ExportOptions options;
    const OutputPlace place = checked_place(typed("out"));
    options.folder = place.folder;
    options.sea = sea;
    options.compute = compute_.resolve();
    options.times = times(options.sea);
    options.maps = maps(place.names);
    options.meshes = meshes_.resolve(options.sea, options.times);
    options.events = events_.resolve(sea.sea.depth_m);
    if (options.events)
        for (const WaterEvent& event : options.events->file->events)
            if (event.hull)
                throw InputError("--events has a hull: export keeps a copy of the events, but not of other files");
    options.water_frame = water_frame_.resolve(false);
    if (options.events)
        require_reachable(*options.events, options.times.time_of(options.times.number(options.times.count() - 1)));
    const bool is_gltf = options.meshes.has(MeshFormat::gltf) || options.meshes.has(MeshFormat::gltf_animation);
    if (is_gltf && options.maps.up_axis != UpAxis::y)
        throw bad_value("--axes", *typed("axes"), "y-up with --mesh gltf: glTF is y-up");
    if (is_gltf && options.maps.unit != LengthUnit::metre)
        throw bad_value("--unit", *typed("unit"), "m with --mesh gltf: glTF uses metres");
    if (options.maps.has(MapKind::foam) && cascades_of(sea.sea) > 1) options.maps.foam_patch = foam_patch();
    for (const std::string flag : {"foam-size", "foam-pixels"})
        if (!options.maps.foam_patch && typed(flag))
            throw InputError("--" + flag + " is " + *typed(flag) + "; it requires --maps foam and several cascades");
    check_applying(options.maps, options.events.has_value());
    if (options.maps.maps.empty() && !options.meshes.any() && !options.events)
        throw bad_value("--maps", no_maps, "--mesh or --events with it, or some maps");
    if (const auto& grid = typed("flipbook")) {
        options.flipbook = grid_in(*grid);
        check_flipbook(options, *grid);
    }
    options.preview = preview_;
    if (preview_ && resume_) throw InputError("--preview cannot be combined with --resume");
    if (preview_ && typed("trace"))
        throw InputError("--preview is given with --trace " + *typed("trace") + ", expected an export without");
    if (overwrite_ && resume_) throw InputError("--overwrite is given with --resume; give one of the two");
    if (overwrite_ && typed("shard"))
        throw InputError("--overwrite is given with --shard " + *typed("shard") +
                         ", expected a whole export: a shard replaces no other export");
    options.resume = resume_;
    options.overwrite = overwrite_;
    options.sync = !no_sync_;
    options.lock = !no_lock_;
    if (const auto& trace = typed("trace")) options.trace = checked_trace(*trace, options);
    if (const auto& shard = typed("shard")) {
        options.shard = parse_shard(*shard);
        if (!options.shard) throw bad_value("--shard", *shard, "I/N with N from 1 to 1000000 and I from 1 to N");
        if (!sequence_outputs(options).empty())
            throw bad_value("--shard", *shard,
                            "files of single frames only: what is made of all frames together is no shard's");
    }
    return options;
}

}  // namespace pelagic::tools
