// `pelagic view`: shows the sea in a window.

#include <CLI/App.hpp>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <memory>
#include <optional>
#include <string>

#include "pelagic/message/one_line.hpp"
#include "pelagic/tools/commands/command.hpp"
#include "pelagic/tools/encode/image_codec.hpp"
#include "pelagic/tools/files/output_folder.hpp"
#include "pelagic/tools/options/scene_options.hpp"
#include "pelagic/tools/options/wave_systems.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/help_formatter.hpp"
#include "pelagic/tools/text/option_text.hpp"
#include "pelagic/viewer/viewer.hpp"

namespace pelagic::tools {
namespace {

/// Returns the first unused numbered name, so that no image is overwritten.
std::filesystem::path next_image(const std::filesystem::path& folder) {
    for (int number = 1;; ++number) {
        char name[32];
        std::snprintf(name, sizeof name, "pelagic_%04d.png", number);
        if (!std::filesystem::exists(folder / name)) return folder / name;
    }
}

std::string point_text(glm::dvec3 p) {
    const auto centimetres = [](double metres) { return number_text(std::round(metres * 100) / 100); };
    return centimetres(p.x) + "," + centimetres(p.y) + "," + centimetres(p.z);
}

std::string degrees_text(double radians) { return number_text(std::round(glm::degrees(radians) * 10) / 10); }

/// Returns the options of the sky and the camera, except those of the sun and the clouds.
std::string light_text(const viewer::ViewSettings& settings) {
    const gl::SkyOptions& sky = settings.sky;
    std::string text = " --visibility " + number_text(std::round(static_cast<double>(sky.visibility_m)));
    if (sky.cloud_seed != gl::SkyOptions().cloud_seed) text += " --cloud-seed " + std::to_string(sky.cloud_seed);
    if (sky.places_moon)
        text += " --moon " + degrees_text(static_cast<double>(sky.moon_azimuth_rad)) + "," +
                degrees_text(static_cast<double>(sky.moon_elevation_rad));
    const auto hundredths = [](float value) {
        return number_text(std::round(static_cast<double>(value) * 100) / 100);
    };
    const gl::CameraSettings defaults;
    if (settings.shading) text += " --shading " + std::string(name_of(*settings.shading));
    if (settings.camera.fixed_ev) text += " --exposure " + hundredths(*settings.camera.fixed_ev);
    if (settings.camera.bias_stops != 0) text += " --exposure-bias " + hundredths(settings.camera.bias_stops);
    if (settings.crest_glow != 1) text += " --crest-glow " + hundredths(settings.crest_glow);
    if (settings.camera.bloom != defaults.bloom) text += " --bloom " + hundredths(settings.camera.bloom);
    return text;
}

/// Returns the `pelagic render` command for the final state of the window. Default values and options
/// without effect are omitted.
std::string render_command_of(const viewer::ViewResult& result) {
    const SeaState& sea = result.settings.sea;
    const SeaState defaults;
    const auto applies = [&](std::string_view field) { return requirement_of(field, sea).empty(); };
    std::string text = "pelagic render --out sea.png";
    if (applies("spectrum")) text += " --spectrum " + std::string(name_of(sea.spectrum));
    if (sea.spreading != defaults.spreading && applies("spreading"))
        text += " --spreading " + std::string(name_of(sea.spreading));
    if (sea.waves != defaults.waves) text += " --waves " + std::string(name_of(sea.waves));
    for (const SeaStateField& field : sea_state_fields()) {
        // "wind_speed_mps" is --wind-speed: the option has no unit suffix.
        const double value = field.value_in(sea);
        if (value == field.value_in(defaults) || !applies(field.name)) continue;
        const bool is_angle = field.name.ends_with("_rad");
        std::string flag(field.name);
        for (const char* unit : {"_mps", "_rad", "_m", "_s"})
            if (flag.ends_with(unit)) flag.erase(flag.size() - std::string_view(unit).size());
        for (char& c : flag)
            if (c == '_') c = '-';
        text += " --" + flag + " " + (is_angle ? degrees_text(value) : number_text(value));
    }
    for (const WaveSystem& system : sea.systems) text += " --system \"" + text_of(system) + '"';
    text += " --camera " + point_text(result.camera.position_m) + " --target " + point_text(result.camera.target_m) +
            " --fov " + degrees_text(result.camera.vertical_view_rad) + " --sun " +
            degrees_text(static_cast<double>(result.settings.sky.sun_azimuth_rad)) + "," +
            degrees_text(static_cast<double>(result.settings.sky.sun_elevation_rad)) + " --clouds " +
            number_text(std::round(static_cast<double>(result.settings.sky.cloud_cover) * 100) / 100) +
            light_text(result.settings) + " --quality " + result.settings.quality + " --time " +
            number_text(std::round(result.time_s * 1000) / 1000) + " --size " + number_text(result.width) + "x" +
            number_text(result.height);
    if (result.settings.surface != gl::Surface::open)
        text += " --surface " + std::string(name_of(result.settings.surface));
    return text;
}

class ViewCommand final : public Command {
   public:
    void add_options(CLI::App& app) override;
    /// Shows the window until it is closed, then prints the command that renders its last view.
    /// Throws InputError, FileError and gl::GlError.
    void run() override;

   private:
    SceneFlags scene_;
    std::optional<std::string> images_;
};

void ViewCommand::add_options(CLI::App& app) {
    scene_.add_to(app, SeaOptions::PresetName::positional_too);
    app.add_option("--images", images_, "folder for the images that key P saves (default: .)")
        ->type_name("DIR")
        ->group(help_group::output);
    app.footer(SceneFlags::description_of_lights());
}

void ViewCommand::run() {
    const SceneOptions scene = scene_.resolve();
    const std::filesystem::path folder = images_.value_or(".");
    if (!std::filesystem::is_directory(folder)) throw bad_value("--images", folder.string(), "a folder that exists");

    viewer::ViewOptions options{.settings = {.sea = scene.sea.sea,
                                             .light = scene.light,
                                             .sky = scene.sky,
                                             .water = scene.water,
                                             .shading = scene.shading,
                                             .camera = scene.settings,
                                             .crest_glow = scene.crest_glow,
                                             .surface = scene.surface,
                                             .flow = scene.flow,
                                             .quality = scene.quality,
                                             .size_m = scene.quadtree.size_m},
                                .camera = scene.camera,
                                .width = scene.width,
                                .height = scene.height,
                                .threads = scene.compute.threads};
    options.floor = scene.floor;
    options.shore = scene.shore;
    options.water_frame = scene.water_frame;
    if (scene.spray != SprayUse::automatic) options.spray = scene.spray == SprayUse::on;
    options.changes = forecast_of(scene.sea).changes;
    options.save_image = [&](std::span<const std::uint8_t> pixels, int width, int height) {
        const std::filesystem::path file = next_image(folder);
        const std::vector<unsigned char> png = encode_png({pixels.begin(), pixels.end()}, width, height);
        OutputFile(file).write(std::as_bytes(std::span(png)));
        std::printf("saved %s\n", escaped(file.string()).c_str());
        std::fflush(stdout);
    };
    const viewer::ViewResult result = viewer::show_sea(options);
    const std::string spray_text =
        scene.spray == SprayUse::automatic ? "" : " --spray " + std::string(name_of(scene.spray));
    std::printf("%llu frames, by %s. Equivalent command without a window:\n  %s\n",
                static_cast<unsigned long long>(result.frames), result.renderer.c_str(),
                (render_command_of(result) + scene_.typed_floor() + scene_.typed_water_frame() + spray_text).c_str());
}

}  // namespace

std::unique_ptr<Command> make_view_command() { return std::make_unique<ViewCommand>(); }

}  // namespace pelagic::tools
