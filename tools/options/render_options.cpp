#include "pelagic/tools/options/render_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "pelagic/tools/maps/name_pattern.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

constexpr int max_rendered_frames = 100'000;
constexpr const char *default_file = "sea.png", *image_extension = ".png", *film_extension = ".mp4";
constexpr double default_film_s = 5;

/// Returns an empty path if the option is not set.
/// \param extensions  accepted ones
/// \param is_one_file  the file holds all frames, so that its name cannot be a pattern
std::filesystem::path checked_file(const std::string& option, const std::optional<std::string>& text,
                                   const std::vector<std::string>& extensions, bool is_one_file) {
    if (!text) return {};
    const std::filesystem::path file = *text;
    const std::string name = file.filename().string();
    if (std::ranges::find(extensions, file.extension().string()) == extensions.end() || file.stem().empty()) {
        std::vector<std::string> names;
        for (const std::string& extension : extensions) names.push_back("*" + extension);
        throw bad_value(option, *text, "a file named " + list_of(names));
    }
    if (NamePattern::is_meant(name) && (is_one_file || !NamePattern::parse(name)))
        throw bad_value(option, *text,
                        is_one_file ? "a name without # and %: it is one file"
                                    : "a name with one number, as sea.####.png or sea.%04d.png, or none");
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) throw bad_value(option, *text, "a file, but that is a folder");
    return file;
}

glm::dvec2 rock_place(const std::string& option, const std::string& text) {
    constexpr double furthest_m = 1e4;
    const auto reject = [&] { return bad_value(option, text, "X,Z in metres, each in [-10000, 10000]"); };
    const std::vector<std::string> numbers = split_at_commas(text);
    if (numbers.size() != 2) throw reject();
    const auto x = parse_number(numbers[0]), z = parse_number(numbers[1]);
    if (!x || !z || std::abs(*x) > furthest_m || std::abs(*z) > furthest_m) throw reject();
    return {*x, *z};
}

}  // namespace

std::filesystem::path RenderOptions::file_of(const std::filesystem::path& named, int frame) const {
    if (const auto pattern = NamePattern::parse(named.filename().string()))
        return named.parent_path() / pattern->name("", frame, pattern->extension());
    if (frames == 1 || named.extension() == film_extension) return named;
    std::array<char, 16> number;
    std::snprintf(number.data(), number.size(), "_%04d", frame);
    return named.parent_path() / (named.stem().string() + number.data() + named.extension().string());
}

void RenderFlags::add_to(CLI::App& app) {
    const auto add = [&](const std::string& names, const std::string& type, const std::string& help) {
        app.add_option("--" + names, typed_[names.substr(0, names.find(','))], help)->type_name(type);
    };
    app.option_defaults()->group(help_group::output);
    add("out,-o,FILE", "FILE.png|mp4", "image, images as FILE.####.png, or a film by ffmpeg (default: sea.png)");
    add("hdr", "FILE.exr", "also write linear radiance; 1: the sun above the atmosphere");
    add("aov", alternatives(names_of<Aov>()), "layers of --hdr, with commas between them");
    add("spray-points", "FILE.ply", "also write the droplets of spray as points");
    add("sky", "FILE.exr", "also write the sky as an environment map, without the sun's disc");
    app.add_flag("--resume", resume_, "keep the images that exist, and render the others");
    app.add_flag("--json", json_, "print statistics as JSON");

    app.option_defaults()->group(help_group::frames);
    add("time", "SECONDS", "time of the first frame; [-1e9, 1e9] (default: 0, or the first of --path)");
    add("frames", "NUMBER", "number of images; 1 to 100000 (default: 1; 5 seconds of a film; all of --path)");
    add("fps", "NUMBER", "images per second; (0, 1000] (default: 24)");

    app.option_defaults()->group(help_group::view);
    add("eye-height", "METRES", "height above the water below the camera, whose place is --camera X,Z; [-100, 10000]");
    add("path", "FILE.csv", "path of the camera: columns time,x,y,z,target_x,target_y,target_z");
    app.add_flag("--wireframe", wireframe_, "draw the mesh, with one colour per level of detail");
    app.add_flag("--stereo", stereo_, "draw the images of both eyes side by side");
    add("rock", "X,Z", "place a rock of about 12 x 6 m; metres in [-10000, 10000]");
    hull_.add_to(app);
    events_.add_to(app);
    scene_.add_to(app);
}

CameraMotion RenderFlags::resolve_motion() const {
    CameraMotion motion;
    if (const auto& text = typed_.at("eye-height"))
        motion.eye_height_m = number_in("--eye-height", *text, -100, 10'000, "[-100, 10000] m");
    if (const auto& file = typed_.at("path")) motion.path = read_camera_path(*file, !motion.eye_height_m);
    return motion;
}

void RenderFlags::resolve_times(RenderOptions& options) const {
    const CameraPath* const path = options.motion.path.get();
    if (path) options.time_s = path->first_s();
    if (const auto& text = typed_.at("time"))
        options.time_s = number_in("--time", *text, -1e9, 1e9, "seconds in [-1e9, 1e9]");
    if (const auto& text = typed_.at("fps"))
        options.fps = number_in("--fps", *text, 1e-6, 1000, "frames a second in (0, 1000]");
    if (const auto& text = typed_.at("frames")) {
        options.frames = whole_number_in("--frames", *text, 1, max_rendered_frames);
    } else if (path) {
        // The last frame is at the last key or before it; rounding must not lose it.
        const double frames = 1 + std::floor(std::max(0., path->last_s() - options.time_s) * options.fps + 1e-6);
        if (frames > max_rendered_frames)
            throw InputError("--path has " + number_text(frames) + " frames, expected at most " +
                             number_text(max_rendered_frames) + "; --frames and --fps choose fewer");
        options.frames = static_cast<int>(frames);
    } else if (options.is_film()) {
        options.frames = std::max(1, static_cast<int>(std::lround(default_film_s * options.fps)));
    }
}

void RenderFlags::resolve_aovs(RenderOptions& options) const {
    const auto& text = typed_.at("aov");
    if (!text) return;
    options.aovs = parse_aovs("--aov", *text);
    if (options.hdr_file.empty()) throw InputError("--aov requires --hdr FILE.exr");
    for (const auto& [flag, is_given] : {std::pair("--stereo", stereo_),
                                         {"--rock", options.rock_m.has_value()},
                                         {"--hull", options.hull.has_value()}})
        if (is_given) throw InputError(std::string("--aov cannot be combined with ") + flag);
    if (std::ranges::find(options.aovs, Aov::velocity) != options.aovs.end() &&
        options.scene.surface != gl::Surface::open)
        throw InputError("--aov velocity requires --surface open");
}

RenderOptions RenderFlags::resolve() const {
    RenderOptions options;
    const auto& out = typed_.at("out");
    options.file =
        checked_file("--out", out, {image_extension, film_extension}, out && out->ends_with(film_extension));
    options.hdr_file = checked_file("--hdr", typed_.at("hdr"), {".exr"}, false);
    options.spray_file = checked_file("--spray-points", typed_.at("spray-points"), {".ply"}, false);
    options.sky_file = checked_file("--sky", typed_.at("sky"), {".exr"}, true);
    if (options.file.empty() && options.hdr_file.empty() && options.sky_file.empty()) options.file = default_file;
    if (options.is_film() && resume_) throw InputError("--resume cannot be combined with a film, --out *.mp4");
    if (options.hdr_file == options.sky_file && !options.sky_file.empty())
        throw bad_value("--sky", options.sky_file.string(), "another file than --hdr");
    if (wireframe_ && !options.hdr_file.empty())
        throw bad_value("--hdr", options.hdr_file.string(),
                        "a sea without --wireframe, whose colours are no radiance");
    options.motion = resolve_motion();
    options.scene = scene_.resolve(options.motion);
    options.has_target = scene_.has_target() || options.motion.path;
    options.wireframe = wireframe_;
    options.stereo = stereo_;
    options.json = json_;
    options.resume = resume_;
    if (options.is_film() && (options.scene.width % 2 != 0 || options.scene.height % 2 != 0))
        throw bad_value("--size", number_text(options.scene.width) + "x" + number_text(options.scene.height),
                        "an even width and height, which films require");

    const auto given = [&](const char* flag, auto use) {
        if (const auto& text = typed_.at(flag)) use("--" + std::string(flag), *text);
    };
    resolve_times(options);
    given("rock", [&](const auto& option, const auto& text) {
        options.rock_m = rock_place(option, text);
        if (stereo_ || wireframe_) throw bad_value(option, text, "an image without --stereo and --wireframe");
    });
    options.hull = hull_.resolve();
    if (options.hull) {
        if (options.scene.surface != gl::Surface::open) throw InputError("--hull requires --surface open");
        for (const auto& [flag, is_given] :
             {std::pair("--stereo", stereo_), {"--wireframe", wireframe_}, {"--rock", options.rock_m.has_value()}})
            if (is_given) throw InputError(std::string("--hull cannot be combined with ") + flag);
    }
    resolve_aovs(options);
    if (!options.spray_file.empty() && !options.has_spray())
        throw InputError("--spray-points requires an image with spray: --surface open and --spray on");
    const double last_s = options.time_s + (options.frames - 1) / options.fps;
    options.events = events_.resolve(options.scene.sea.sea.depth_m,
                                     options.hull ? std::optional(options.hull->place()) : std::nullopt);
    if (options.events) require_reachable(*options.events, last_s);
    if (options.hull) require_reachable(options.time_s, last_s);
    return options;
}

}  // namespace pelagic::tools
