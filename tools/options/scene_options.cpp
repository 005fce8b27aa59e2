#include "pelagic/tools/options/scene_options.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "pelagic/gl/sky/light_presets.hpp"
#include "pelagic/gl/water/sea_renderer.hpp"
#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/encode/flow_file.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

constexpr int max_pixels_per_side = 8192;

void read_size(SceneOptions& options, const std::string& text) {
    const std::size_t x = text.find('x');
    const auto side = [&](std::string_view digits) {
        const std::int64_t pixels = parse_integer(digits).value_or(0);
        if (pixels < 16 || pixels > max_pixels_per_side)
            throw bad_value("--size", text, "WIDTHxHEIGHT, each from 16 to " + number_text(max_pixels_per_side));
        return static_cast<int>(pixels);
    };
    options.width = side(std::string_view(text).substr(0, x));
    options.height = side(x == std::string::npos ? "" : std::string_view(text).substr(x + 1));
}

void read_direction(const std::string& option, const std::string& text, float& azimuth_rad, float& elevation_rad) {
    const std::vector<std::string> angles = split_at_commas(text);
    const auto azimuth = parse_number(angles[0]), elevation = parse_number(angles.size() == 2 ? angles[1] : "");
    if (!azimuth || !elevation || std::abs(*azimuth) > 3600 || std::abs(*elevation) > 90)
        throw bad_value(option, text, "AZIMUTH,ELEVATION in degrees, elevation in [-90, 90]");
    azimuth_rad = static_cast<float>(*azimuth * radians_per_degree);
    elevation_rad = static_cast<float>(*elevation * radians_per_degree);
}

void choose_surface(SceneOptions& options, const std::string& name, const std::optional<std::string>& flow_file) {
    options.surface = one_of<gl::Surface>("--surface", name);
    if (!flow_file) return;
    if (options.surface != gl::Surface::river) throw InputError("--flow requires --surface river");
    options.flow = read_flow_map("--flow", *flow_file);
}

/// \param max_height_m  largest height of the camera
void choose_quality(SceneOptions& options, const std::string& name, double max_height_m) {
    const QuadtreePreset* preset = quadtree_preset_named(name);
    if (!preset) {
        std::vector<std::string> names;
        for (const QuadtreePreset& each : quadtree_presets()) names.emplace_back(each.name);
        throw unknown_name("--quality", name, names);
    }
    options.quality = name;
    // A high camera sees far and needs a large square, because waves fade out at 5/16 of its side.
    // Small water bodies are seen from near and have short waves, which need the finer vertices of
    // a small square.
    const double size_m = options.surface != gl::Surface::open ? 512
                          : max_height_m > 100                 ? 8192
                                                               : 4096;
    options.quadtree =
        options.surface == gl::Surface::open ? preset->options_near_water(size_m) : preset->options(size_m);
}

gl::WaterOptics chosen_water(const std::optional<std::string>& type, const std::optional<std::string>& chlorophyll) {
    if (type && chlorophyll)
        throw InputError(
            "--water and --chlorophyll are both given; each says what the water is made of; give one of them");
    if (chlorophyll)
        return gl::water_optics_of_chlorophyll(
            static_cast<float>(number_in("--chlorophyll", *chlorophyll, 0.01, 30, "mg/m^3 in [0.01, 30]")));
    const std::string name = type.value_or(std::string(gl::default_jerlov_type));
    const std::vector<std::string> names(gl::jerlov_types().begin(), gl::jerlov_types().end());
    if (std::ranges::find(names, name) == names.end()) throw unknown_name("--water", name, names);
    return gl::water_optics(name);
}

const gl::LightPreset& light_named(const std::string& option, const std::string& name) {
    if (const gl::LightPreset* light = gl::light_preset_named(name)) return *light;
    std::vector<std::string> names;
    for (const gl::LightPreset& each : gl::light_presets()) names.emplace_back(each.name);
    throw unknown_name(option, name, names);
}

/// Returns the camera of the options. Without --camera it is above the highest crests.
Camera chosen_camera(const CameraFlags& flags, const CameraMotion& motion, const SeaState& sea, double sea_level_m) {
    Camera camera = flags.resolve(sea_level_m, motion);
    if (!flags.has_place() && !motion.path && !motion.eye_height_m)
        camera.position_m.y =
            std::max(camera.position_m.y, sea_level_m + 2 + 1.2 * expected_waves(sea).significant_wave_height_m);
    return camera;
}

/// Returns a sky whose cloud cover increases and whose visibility decreases with the wind speed.
gl::SkyOptions default_sky(const SeaState& sea) {
    const double wind = sea.wind_speed_mps;
    return {.sun_azimuth_rad = static_cast<float>(80 * radians_per_degree),
            .sun_elevation_rad = static_cast<float>(32 * radians_per_degree),
            .cloud_cover = static_cast<float>(std::clamp(0.22 + 0.022 * wind, 0.2, 0.75)),
            .visibility_m = static_cast<float>(std::clamp(60e3 - 2e3 * wind, 12e3, 60e3))};
}

}  // namespace

void SceneFlags::add_to(CLI::App& app, SeaOptions::PresetName preset) {
    const auto add = [&](const std::string& flag, const std::string& type, const std::string& help) {
        app.add_option("--" + flag, typed_[flag], help)->type_name(type);
    };
    app.option_defaults()->group(help_group::view);
    add("size", "WxH", "image size in pixels, each from 16 to 8192 (default: 1280x720)");
    camera_.add_to(app);
    add("quality", "low|medium|high|ultra", "level of detail (default: high)");
    add("shading", alternatives(names_of<gl::Shading>()),
        "shading quality (default: high; in a window, adapted to the frame time)");

    app.option_defaults()->group(help_group::light);
    std::vector<std::string_view> lights;
    for (const gl::LightPreset& light : gl::light_presets()) lights.push_back(light.name);
    add("light", alternatives(lights), "preset of sky and exposure, which the options below override");
    add("sun", "AZIMUTH,ELEVATION", "direction in degrees; azimuth from +x to +z (default: 80,32)");
    add("moon", "AZIMUTH,ELEVATION", "direction in degrees (default: opposite the sun, full)");
    add("clouds", "FRACTION", "cloud cover; [0, 1] (default: depends on the wind)");
    add("cloud-seed", "NUMBER", "seed of the clouds; 0 to 4294967295 (default: 108, or that of --light)");
    add("visibility", "METRES", "distance of 2 % contrast; [500, 300000] (default: depends on the wind)");
    add("crest-glow", "GAIN", "factor on light through wave crests; [0, 10]; 1 is true to nature (default: 1)");
    add("exposure", "EV", "exposure value at ISO 100; [-10, 20], or auto: metered (default: auto)");
    add("exposure-bias", "STOPS", "exposure compensation; [-5, 5] (default: 0)");
    add("bloom", "FRACTION", "light scattered in the lens; [0, 1] (default: 0.04)");

    app.option_defaults()->group(help_group::water);
    add("surface", alternatives(names_of<gl::Surface>()), "kind of water body (default: open)");
    add("spray", alternatives(names_of<SprayUse>()),
        "spray of breaking crests (default: auto: not with --shading headset)");
    add("water", "TYPE", "Jerlov type: I, IA, IB, II, III, or 1C to 9C at coasts (default: II)");
    add("chlorophyll", "MG_PER_M3", "concentration, instead of --water; [0.01, 30]");
    add("flow", "FILE.png", "flow map of a river (default: a winding channel)");
    floor_.add_to(app);
    sea_.add_to(app, preset);
    sea_.add_weather_to(app);
    water_frame_.add_to(app);
    compute_.add_to(app);
}

std::string SceneFlags::description_of_lights() {
    std::string text = "Light presets:";
    for (const gl::LightPreset& light : gl::light_presets()) {
        const std::string name = "\n  " + std::string(light.name);
        text.append(name).append(18 - name.size(), ' ').append(light.meaning);
    }
    return text;
}

void SceneFlags::read_camera_settings(gl::CameraSettings& settings) const {
    const auto given = [&](const char* flag, auto use) {
        if (const auto& text = typed_.at(flag)) use("--" + std::string(flag), *text);
    };
    given("exposure", [&](const auto& option, const auto& text) {
        if (text == "auto") return;
        settings.fixed_ev = static_cast<float>(number_in(option, text, double{gl::min_ev}, double{gl::max_ev},
                                                         "auto, or an exposure value in [-10, 20]"));
    });
    given("exposure-bias", [&](const auto& option, const auto& text) {
        const auto max = double{gl::max_bias_stops};
        settings.bias_stops = static_cast<float>(number_in(option, text, -max, max, "stops in [-5, 5]"));
    });
    given("bloom", [&](const auto& option, const auto& text) {
        settings.bloom = static_cast<float>(number_in(option, text, 0, 1, "a fraction in [0, 1]"));
    });
}

SceneOptions SceneFlags::resolve(const CameraMotion& motion) const {
    SceneOptions options;
    options.sea = sea_.resolve();
    print_weather_note(options.sea);
    options.compute = compute_.resolve();
    options.sky = default_sky(options.sea.sea);
    options.water_frame = water_frame_.resolve(floor_.has_shore());
    const FloorOptions floor = floor_.resolve(options.sea);
    if (floor.field) options.floor = gl::floor_of(*floor.field);
    options.shore = floor.shore();
    options.camera = chosen_camera(camera_, motion, options.sea.sea, options.water_frame.sea_level_m);

    const auto given = [&](const char* flag, auto use) {
        if (const auto& text = typed_.at(flag)) use("--" + std::string(flag), *text);
    };
    given("size", [&](const auto&, const auto& text) { read_size(options, text); });
    given("light", [&](const auto& option, const auto& text) {
        const gl::LightPreset& light = light_named(option, text);
        options.light = light.name;
        options.sky = light.sky;
        options.settings.bias_stops = light.bias_stops;
        options.crest_glow = light.crest_glow;
    });
    given("sun", [&](const auto& option, const auto& text) {
        read_direction(option, text, options.sky.sun_azimuth_rad, options.sky.sun_elevation_rad);
    });
    given("moon", [&](const auto& option, const auto& text) {
        read_direction(option, text, options.sky.moon_azimuth_rad, options.sky.moon_elevation_rad);
        options.sky.places_moon = true;
    });
    given("clouds", [&](const auto& option, const auto& text) {
        options.sky.cloud_cover = static_cast<float>(number_in(option, text, 0, 1, "a fraction in [0, 1]"));
    });
    given("cloud-seed", [&](const auto& option, const auto& text) {
        const auto seed = parse_integer(text);
        if (!seed || *seed < 0 || *seed > std::numeric_limits<std::uint32_t>::max())
            throw bad_value(option, text, "a whole number from 0 to 4294967295");
        options.sky.cloud_seed = static_cast<std::uint32_t>(*seed);
    });
    given("shading",
          [&](const auto& option, const auto& text) { options.shading = one_of<gl::Shading>(option, text); });
    options.water = chosen_water(typed_.at("water"), typed_.at("chlorophyll"));
    given("visibility", [&](const auto& option, const auto& text) {
        options.sky.visibility_m = static_cast<float>(number_in(option, text, 500, 300e3, "metres in [500, 300000]"));
    });
    given("crest-glow", [&](const auto& option, const auto& text) {
        const auto max = double{gl::max_crest_glow};
        options.crest_glow = static_cast<float>(number_in(option, text, 0, max, "a factor in [0, 10]"));
    });
    read_camera_settings(options.settings);
    choose_surface(options, typed_.at("surface").value_or("open"), typed_.at("flow"));
    given("spray", [&](const auto& option, const auto& text) {
        options.spray = one_of<SprayUse>(option, text);
        if (options.spray == SprayUse::on && options.surface != gl::Surface::open)
            throw InputError("--spray on requires --surface open");
    });
    if (options.shore && options.surface != gl::Surface::open) throw InputError("--shore requires --surface open");
    const bool has_heights = motion.path && !motion.eye_height_m;
    choose_quality(options, typed_.at("quality").value_or("high"),
                   has_heights ? motion.path->max_height_m() : options.camera.position_m.y);
    return options;
}

}  // namespace pelagic::tools
