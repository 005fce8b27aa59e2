#include "tools/render_options.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <vector>

#include "sim/statistics.hpp"
#include "tools/errors.hpp"
#include "tools/option_text.hpp"

namespace pelagic::tools {
namespace {

constexpr double radians_per_degree = 3.14159265358979323846 / 180;
constexpr int most_pixels_a_side = 8192;
constexpr int most_frames = 100'000;

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

/// As typed; without a place, above the highest crests.
gl::Camera chosen_camera(const CameraFlags& flags, const SeaState& sea) {
    Camera camera = flags.resolve();
    if (!flags.has_place())
        camera.eye_m.y = std::max(camera.eye_m.y, 2 + 1.2 * expected_waves(sea).significant_wave_height_m);
    return {.position_m = camera.eye_m,
            .target_m = camera.target_m,
            .vertical_view_rad = camera.fov_deg * radians_per_degree};
}

/// The stronger the wind, the more clouds and spray: a fair day at 3 m/s, a ragged sky in a gale.
gl::SkyOptions usual_sky(const SeaState& sea) {
    const double wind = sea.wind_speed_mps;
    return {.sun_azimuth_rad = static_cast<float>(80 * radians_per_degree),
            .sun_elevation_rad = static_cast<float>(32 * radians_per_degree),
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
    camera_.add_to(app);
    add("sun", "AZIMUTH,ELEVATION", "degrees, from +x towards +z and [-90, 90] above the horizon; default 80,32");
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
    options.camera = chosen_camera(camera_, options.sea.sea);
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
