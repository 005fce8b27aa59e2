#include "pelagic/tools/options/render_options.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

constexpr int max_frames = 100'000;

/// Returns an empty path if the option is not set. \param extension  ".png" or ".exr"
std::filesystem::path checked_file(const std::string& option, const std::optional<std::string>& text,
                                   const std::string& extension) {
    if (!text) return {};
    const std::filesystem::path file = *text;
    if (file.extension() != extension || file.stem().empty())
        throw bad_value(option, *text, "a file named *" + extension);
    if (file.filename().string().find('%') != std::string::npos)
        throw bad_value(
            option, *text,
            "a name without %: with --frames, FILE" + extension + " becomes FILE_0000" + extension + " and so on");
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
    if (frames == 1) return named;
    std::array<char, 16> number;
    std::snprintf(number.data(), number.size(), "_%04d", frame);
    return named.parent_path() / (named.stem().string() + number.data() + named.extension().string());
}

void RenderFlags::add_to(CLI::App& app) {
    const auto add = [&](const std::string& flag, const std::string& type, const std::string& help) {
        app.add_option("--" + flag, typed_[flag], help)->type_name(type);
    };
    add("out", "FILE.png", "write the image; with --frames, FILE_0000.png and so on");
    add("hdr", "FILE.exr",
        "write the image's linear radiance as 32-bit floats; the sun's irradiance above the atmosphere is 1");
    add("sky", "FILE.exr", "write the sky as an environment map of 2048x1024 pixels, without the sun's disc");
    add("time", "SECONDS", "time of the first frame; [-1e9, 1e9] (default: 0)");
    add("frames", "NUMBER", "number of images; 1 to 100000 (default: 1)");
    add("fps", "NUMBER", "images per second; (0, 1000] (default: 24)");
    add("rock", "X,Z",
        "place a rock, about 12 m wide and 6 m high, and its reflection at this position; metres, each in "
        "[-10000, 10000]");
    app.add_flag("--wireframe", wireframe_, "draw the mesh as wireframe, with one colour per level of detail");
    app.add_flag("--stereo", stereo_, "draw the images of both eyes side by side");
    app.add_flag("--json", json_, "print draw calls, triangles, bytes and times as JSON");
    events_.add_to(app);
    scene_.add_to(app);
}

RenderOptions RenderFlags::resolve() const {
    RenderOptions options;
    options.file = checked_file("--out", typed_.at("out"), ".png");
    options.hdr_file = checked_file("--hdr", typed_.at("hdr"), ".exr");
    options.sky_file = checked_file("--sky", typed_.at("sky"), ".exr");
    if (options.file.empty() && options.hdr_file.empty() && options.sky_file.empty())
        throw InputError("--out is missing: expected a PNG file to write; or give --hdr or --sky, an EXR file");
    if (options.hdr_file == options.sky_file && !options.sky_file.empty())
        throw bad_value("--sky", options.sky_file.string(), "another file than --hdr");
    if (wireframe_ && !options.hdr_file.empty())
        throw bad_value("--hdr", options.hdr_file.string(),
                        "a sea without --wireframe, whose colours are no radiance");
    options.scene = scene_.resolve();
    options.wireframe = wireframe_;
    options.stereo = stereo_;
    options.json = json_;

    const auto given = [&](const char* flag, auto use) {
        if (const auto& text = typed_.at(flag)) use("--" + std::string(flag), *text);
    };
    given("time", [&](const auto& option, const auto& text) {
        options.time_s = number_in(option, text, -1e9, 1e9, "seconds in [-1e9, 1e9]");
    });
    given("frames", [&](const auto& option, const auto& text) {
        options.frames = whole_number_in(option, text, 1, max_frames);
    });
    given("rock", [&](const auto& option, const auto& text) {
        options.rock_m = rock_place(option, text);
        if (stereo_ || wireframe_) throw bad_value(option, text, "an image without --stereo and --wireframe");
    });
    given("fps", [&](const auto& option, const auto& text) {
        options.fps = number_in(option, text, 1e-6, 1000, "frames a second in (0, 1000]");
    });
    options.events = events_.resolve(options.scene.sea.sea.depth_m);
    if (options.events) require_reachable(*options.events, options.time_s + (options.frames - 1) / options.fps);
    return options;
}

}  // namespace pelagic::tools
