#include "tools/render_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <glm/geometric.hpp>
#include <vector>

#include "sim/statistics.hpp"
#include "tools/errors.hpp"
#include "tools/option_text.hpp"

namespace pelagic::tools {
namespace {

constexpr double radians_per_degree = 3.14159265358979323846 / 180;
constexpr int most_pixels_a_side = 8192;
constexpr int most_frames = 100'000;
constexpr double furthest_m = 1e6;

double number_in(const std::string& option, const std::string& text, double least, double most,
                 const std::string& accepted) {
    const auto value = parse_number(text);
    if (!value || *value < least || *value > most) throw bad_value(option, text, accepted);
    return *value;
}

std::vector<double> numbers(const std::string& option, const std::string& text, std::size_t count, double most,
                            const std::string& accepted) {
    std::vector<double> values;
    for (const std::string& part : split_at_commas(text))
        values.push_back(number_in(option, part.empty() ? text : part, -most, most, accepted));
    if (values.size() != count) throw bad_value(option, text, accepted);
    return values;
}

void read_size(RenderOptions& options, const std::string& text) {
    const std::size_t x = text.find('x');
    const auto side = [&](std::string_view digits) {
        const std::int64_t pixels = parse_integer(digits).value_or(0);
        if (pixels < 16 || pixels > most_pixels_a_side)
            throw bad_value("--size", text, "WIDTHxHEIGHT, each from 16 to " + std::to_string(most_pixels_a_side));
        return static_cast<int>(pixels);
    };
    options.width = side(std::string_view(text).substr(0, x));
    options.height = side(x == std::string::npos ? "" : std::string_view(text).substr(x + 1));
}

std::filesystem::path checked_file(const std::optional<std::string>& text) {
    if (!text || text->empty()) throw InputError("--out is missing, needs a PNG file to write");
    const std::filesystem::path file = *text;
    if (file.extension() != ".png" || file.stem().empty()) throw bad_value("--out", *text, "a file named *.png");
    std::error_code error;
    if (std::filesystem::is_directory(file, error)) throw bad_value("--out", *text, "a file, but that is a folder");
    return file;
}

void choose_quality(RenderOptions& options, const std::string& name) {
    const QuadtreePreset* preset = quadtree_preset_named(name);
    if (!preset) {
        std::vector<std::string> names;
        for (const QuadtreePreset& each : quadtree_presets()) names.emplace_back(each.name);
        throw bad_value("--quality", name, list_of(names) + " (the nearest is " + nearest_name(name, names) + ")");
    }
    options.quality = name;
    // From high up one sees far: waves end at 5/16 of the square's side.
    const double size_m = options.camera.position_m.y > 100 ? 8192 : 4096;
    options.quadtree = preset->options(size_m);
}

/// A boat's view along +x: above the crests, a little downwards.
gl::Camera usual_camera(const SeaState& sea) {
    const double height = 2 + 1.1 * expected_waves(sea).significant_wave_height_m;
    return {.position_m = {0, height, 0}, .target_m = {100, height - 8, 0}, .vertical_view_rad = 45 * radians_per_degree};
}

/// The stronger the wind, the more clouds and spray: a fair day at 3 m/s, a ragged sky in a gale.
gl::SkyOptions usual_sky(const SeaState& sea) {
    const double wind = sea.wind_speed_mps;
    return {.sun_azimuth_rad = static_cast<float>(38 * radians_per_degree),
            .sun_elevation_rad = static_cast<float>(28 * radians_per_degree),
            .cloud_cover = static_cast<float>(std::clamp(0.22 + 0.022 * wind, 0.2, 0.75)),
            .visibility_m = static_cast<float>(std::clamp(60e3 - 2e3 * wind, 12e3, 60e3))};
}

}  // namespace

std::filesystem::path RenderOptions::file_of(int frame) const {
    if (frames == 1) return file;
    std::array<char, 16> number;
    std::snprintf(number.data(), number.size(), "_%04d.png", frame);
    return file.parent_path() / (file.stem().string() + number.data());
}

void RenderFlags::add_to(CLI::App& app) {
    const auto add = [&](const std::string& flag, const std::string& type, const std::string& help) {
        app.add_option("--" + flag, typed_[flag], help)->type_name(type);
    };
    add("out", "FILE.png", "the picture; with --frames FILE_0000.png and so on");
    add("size", "WxH", "pixels, each side from 16 to 8192; default 1280x720");
    add("time", "SECONDS", "of the first frame, in [-1e9, 1e9]; default 0");
    add("frames", "NUMBER", "how many pictures; 1 to 100000, default 1");
    add("fps", "NUMBER", "pictures a second; (0, 1000], default 24");
    add("camera", "X,Y,Z", "where the eye is, metres, y above the rest level; default above the crests");
    add("target", "X,Y,Z", "what it looks at; default 100 m along +x");
    add("fov", "DEGREES", "vertical field of view, [5, 150]; default 45");
    add("sun", "AZIMUTH,ELEVATION", "degrees, from +x towards +z and [-90, 90] above the horizon; default 38,28");
    add("clouds", "PART", "of the sky, [0, 1]; default by the wind");
    add("quality", "NAME", "level of detail: low, medium, high or ultra; default high");
    app.add_flag("--wireframe", wireframe_, "the mesh, a colour for each level of detail");
    app.add_flag("--stereo", stereo_, "both eyes beside one another");
    app.add_flag("--json", json_, "draw calls, triangles, bytes and times, for programs");
    sea_.add_to(app);
    compute_.add_to(app);
}

RenderOptions RenderFlags::resolve() const {
    RenderOptions options;
    options.file = checked_file(typed_.at("out"));
    options.sea = sea_.resolve();
    options.compute = compute_.resolve();
    options.wireframe = wireframe_;
    options.stereo = stereo_;
    options.json = json_;
    options.camera = usual_camera(options.sea.sea);
    options.sky = usual_sky(options.sea.sea);

    const auto given = [&](const char* flag, auto use) {
        if (const auto& text = typed_.at(flag)) use("--" + std::string(flag), *text);
    };
    given("size", [&](const auto&, const auto& text) { read_size(options, text); });
    given("time", [&](const auto& option, const auto& text) {
        options.time_s = number_in(option, text, -1e9, 1e9, "seconds in [-1e9, 1e9]");
    });
    given("frames", [&](const auto& option, const auto& text) {
        const auto count = parse_integer(text);
        if (!count || *count < 1 || *count > most_frames)
            throw bad_value(option, text, "a whole number from 1 to " + std::to_string(most_frames));
        options.frames = static_cast<int>(*count);
    });
    given("fps", [&](const auto& option, const auto& text) {
        options.fps = number_in(option, text, 1e-6, 1000, "frames a second in (0, 1000]");
    });
    const auto point = [&](const std::string& option, const std::string& text) {
        const auto xyz = numbers(option, text, 3, furthest_m, "three numbers X,Y,Z in [-1e6, 1e6], metres");
        return glm::dvec3(xyz[0], xyz[1], xyz[2]);
    };
    given("camera", [&](const auto& option, const auto& text) {
        options.camera.position_m = point(option, text);
        options.camera.target_m = options.camera.position_m + glm::dvec3(100, -8, 0);
    });
    given("target", [&](const auto& option, const auto& text) { options.camera.target_m = point(option, text); });
    if (glm::distance(options.camera.position_m, options.camera.target_m) < 1e-3)
        throw InputError("--target is where --camera is, needs another point to look at");
    given("fov", [&](const auto& option, const auto& text) {
        options.camera.vertical_view_rad = radians_per_degree * number_in(option, text, 5, 150, "degrees in [5, 150]");
    });
    given("sun", [&](const auto& option, const auto& text) {
        const std::string accepted = "AZIMUTH,ELEVATION in degrees, elevation in [-90, 90]";
        const auto angles = numbers(option, text, 2, 3600, accepted);
        if (std::abs(angles[1]) > 90) throw bad_value(option, text, accepted);
        options.sky.sun_azimuth_rad = static_cast<float>(angles[0] * radians_per_degree);
        options.sky.sun_elevation_rad = static_cast<float>(angles[1] * radians_per_degree);
    });
    given("clouds", [&](const auto& option, const auto& text) {
        options.sky.cloud_cover = static_cast<float>(number_in(option, text, 0, 1, "a part in [0, 1]"));
    });
    choose_quality(options, typed_.at("quality").value_or("high"));
    return options;
}

}  // namespace pelagic::tools
