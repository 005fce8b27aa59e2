// `pelagic render`: renders images of a sea offscreen.

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/gl/display.hpp"
#include "pelagic/gl/headless_context.hpp"
#include "pelagic/gl/light_meter.hpp"
#include "pelagic/gl/meshes/lit_mesh.hpp"
#include "pelagic/gl/meshes/rock.hpp"
#include "pelagic/gl/render_target.hpp"
#include "pelagic/gl/sky/sky_panorama.hpp"
#include "pelagic/gl/software_renderer.hpp"
#include "pelagic/gl/stopwatch.hpp"
#include "pelagic/gl/water/sea_pass.hpp"
#include "pelagic/message/one_line.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"
#include "pelagic/tools/aov/aov.hpp"
#include "pelagic/tools/commands/command.hpp"
#include "pelagic/tools/encode/film.hpp"
#include "pelagic/tools/encode/image_codec.hpp"
#include "pelagic/tools/events/event_player.hpp"
#include "pelagic/tools/files/output_folder.hpp"
#include "pelagic/tools/hulls/hull_player.hpp"
#include "pelagic/tools/meshes/hull_file.hpp"
#include "pelagic/tools/meshes/mesh.hpp"
#include "pelagic/tools/options/render_options.hpp"
#include "pelagic/tools/record/sea_json.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/progress.hpp"
#include "pelagic/tools/text/stop_signal.hpp"

namespace pelagic::tools {
namespace {

constexpr int samples_per_pixel = 4;
/// Texels along an edge of a face of the sky's cube map. A texel is 0.18 degrees wide, about three
/// pixels of an image of default size.
constexpr int sky_face_size = 512;
/// Width of the image that meters the exposure, pixels; it shows the same view.
constexpr int metered_width = 320;
/// Size of the panorama of the sky, in pixels. A texel is as wide as one of the cube map.
constexpr int panorama_width = 2048, panorama_height = 1024;
constexpr const char* fastest_quality = "low";
/// Distance between the eyes, in metres (Dodgson 2004: mean 63 mm).
constexpr double eye_distance_m = 0.063;

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

gl::Sky baked_sky(const SceneOptions& scene) {
    gl::SkyBaker baker(make_default_executor(scene.compute.threads), sky_face_size);
    baker.schedule(scene.sky);
    return baker.complete();
}

/// Returns a mesh that is smooth up to creases of 40 degrees: a HullMesh has no normals.
gl::LitMesh drawn_hull(const gl::Functions& functions, const HullMesh& hull) {
    constexpr glm::vec3 paint(0.55f, 0.54f, 0.5f);  // albedo
    const auto normals = corner_normals(hull, glm::radians(40.0));
    std::vector<gl::MeshVertex> vertices;
    std::vector<std::uint16_t> indices;
    for (std::size_t triangle = 0; triangle < normals.size(); ++triangle)
        for (std::size_t corner = 0; corner < 3; ++corner) {
            indices.push_back(static_cast<std::uint16_t>(vertices.size()));
            vertices.push_back({hull.vertices()[hull.triangles()[triangle][corner]], normals[triangle][corner], paint});
        }
    return {functions, vertices, indices, "boat.frag.glsl"};
}
static_assert(3 * HullMesh::max_triangles <= 0xffff, "indices of 16 bits");

/// Renders frames offscreen. Ocean, renderer and targets are created once.
class OfflineRenderer {
   public:
    OfflineRenderer(const RenderOptions& options, const gl::Sky& sky, Progress& progress)
        : options_(options),
          sky_(sky),
          ocean_(forecast_of(options.scene.sea), {.executor = make_default_executor(options.scene.compute.threads),
                                                  .isa = options.scene.compute.isa,
                                                  .queries = true,
                                                  .velocities = velocities_of(options),
                                                  .depth = options.hull.has_value(),
                                                  .slopes = true,
                                                  .foam = true,
                                                  .shore = options.scene.shore,
                                                  .spray = spray_of(options)}),
          target_(context_.functions(), options.scene.width, options.scene.height, samples_per_pixel,
                  options.wireframe ? gl::PixelKind::screen : gl::PixelKind::radiance),
          pass_(context_.functions(),
                {.resolution = ocean_.resolution(),
                 .cascades = ocean_.cascade_count(),
                 .shading = options.scene.shading.value_or(gl::Shading::high),
                 .writes = gl::PixelKind::radiance,
                 .surface = options.scene.surface,
                 .executor = make_default_executor(options.scene.compute.threads),
                 .dynamic_waves = options.events.has_value()},
                options.scene.quadtree, gl::CausticsBaking::before_drawn),
          luminance_of_unit_(sky.luminance_of_unit()),
          unit_(sky.unit) {
        if (const std::string name = context_.renderer_name();
            gl::is_software_renderer(name) && options.scene.quality != fastest_quality)
            progress.note(name + " draws without a graphics processor; --quality " + fastest_quality + " is faster");
        ocean_.set_water_frame(options.scene.water_frame);
        pass_.renderer().set_water(options.scene.water);
        pass_.renderer().set_floor(options.scene.floor);
        if (options.scene.flow) pass_.renderer().set_flow(*options.scene.flow);
        pass_.renderer().set_sky(sky);
        center_spray();
        if (options.events)
            player_.emplace(*options.events, make_default_executor(options.scene.compute.threads),
                            options.scene.compute.isa, options.scene.water_frame,
                            options.hull ? std::optional(HullPlayer::begins_s(options.time_s)) : std::nullopt);
        if (options.hull) {
            hull_.emplace(*options.hull, ocean_, *player_, options.time_s,
                          make_default_executor(options.scene.compute.threads), options.has_spray());
            hull_mesh_.emplace(drawn_hull(context_.functions(), options.hull->hull->mesh()));
        }
        if (options.rock_m) {
            rock_.emplace(context_.functions(), glm::dvec3(options.rock_m->x, 0, options.rock_m->y));
        }
        if (!options.aovs.empty()) {
            data_.emplace(context_.functions(), options.scene.width, options.scene.height, 0, gl::PixelKind::data);
            jobs_.emplace(make_default_executor(options.scene.compute.threads));
        }
        if (options.wireframe || options.file.empty()) return;
        display_.emplace(context_.functions());
        screen_.emplace(context_.functions(), options.scene.width, options.scene.height, 0);
        const gl::CameraSettings& settings = options.scene.settings;
        ev_ = settings.fixed_ev ? *settings.fixed_ev : metered_ev() - settings.bias_stops;
    }

    /// Renders a frame; pixels() and radiance() return the result.
    void draw(double time_s) {
        const gl::Stopwatch all;
        time_s_ = time_s;
        if (hull_) moment_ = hull_->at(time_s);
        center_spray();
        Frame frame = ocean_.frame_at(time_s);
        droplets_ = frame.droplets;
        if (player_) frame = with_water(frame, player_->at(time_s));
        sea_ms_.push_back(all.milliseconds());

        pass_.upload(frame);
        eyes_ = eyes_in(camera_in(frame, time_s), options_.scene.width, options_.scene.height);
        if (!options_.hdr_file.empty()) {
            drawn_.push_back(draw(eyes_, target_, false));
            radiance_ = target_.read_radiance();
            if (data_) aovs_ = aovs_in(frame);
        }
        if (!options_.file.empty()) {
            drawn_.push_back(draw(eyes_, target_, true));
            pixels_ = options_.wireframe ? target_.read() : shown();
        }
        image_ms_.push_back(all.milliseconds());
    }

    /// Returns RGBA8 pixels, top row first.
    const std::vector<std::uint8_t>& pixels() const { return pixels_; }
    /// Returns the radiance as RGB, top row first.
    std::vector<float> radiance() const {
        std::vector<float> rgb;
        for (std::size_t i = 0; i < radiance_.size(); i += 4)
            for (std::size_t c = 0; c < 3; ++c) rgb.push_back(unit_ * radiance_[i + c]);
        return rgb;
    }

    std::span<const SprayDroplet> droplets() const { return droplets_; }  ///< of the drawn frame
    /// Returns the values of --aov for each pixel, top row first.
    const std::vector<float>& aovs() const { return aovs_; }

    Json statistics() const {
        const gl::DrawStatistics& last = drawn_.back();
        const auto median_of = [&](double gl::DrawStatistics::*const ms) {
            std::vector<double> values;
            for (const gl::DrawStatistics& each : drawn_) values.push_back(each.*ms);
            return median(std::move(values));
        };
        const auto views = static_cast<int>(eyes_.size());
        Json json = {{"renderer", context_.renderer_name()},
                     {"frames", sea_ms_.size()},
                     {"views", views},
                     {"sea_draw_calls", last.sea_calls},
                     {"sea_draw_calls_per_view", last.sea_calls / views},
                     {"sky_draw_calls", last.sky_calls},
                     {"triangles", last.triangles},
                     {"patches", pass_.selection().list().instances.size()},
                     {"uploaded_bytes", last.upload_bytes},
                     {"instance_bytes", last.instance_bytes},
                     {"spray_droplets", droplets_.size()},
                     {"median_ms",
                      {{"sea", median(sea_ms_)},
                       {"select", median_of(&gl::DrawStatistics::select_ms)},
                       {"upload", median_of(&gl::DrawStatistics::upload_ms)},
                       {"upload_in_driver", median_of(&gl::DrawStatistics::upload_driver_ms)},
                       {"draw", median_of(&gl::DrawStatistics::draw_ms)},
                       {"draw_in_driver", median_of(&gl::DrawStatistics::draw_driver_ms)},
                       {"image", median(image_ms_)}}},
                     {"exposure_ev", ev_}};
        if (moment_) json["hull"] = Json::parse(hull_row(time_s_, *moment_, true));
        return json;
    }

   private:
    static std::optional<SprayOptions> spray_of(const RenderOptions& options) {
        return options.has_spray() ? std::optional(gl::drawn_spray) : std::nullopt;
    }

    static Velocities velocities_of(const RenderOptions& options) {
        const bool has_velocity = std::ranges::find(options.aovs, Aov::velocity) != options.aovs.end();
        return has_velocity ? Velocities::drawn : Velocities::none;
    }

    /// Centres the spray on a grid near the camera. Droplets depend on the centre at past ticks, so
    /// where it moves, a frame of another time makes the ocean forget them: an image depends on its
    /// frame alone, as with --resume.
    void center_spray() {
        if (!spray_of(options_)) return;
        constexpr double step_m = 20;  // of a reach of 160 m
        glm::dvec2 center(options_.scene.camera.position_m.x, options_.scene.camera.position_m.z);
        if (const auto& path = options_.motion.path) {
            const glm::dvec3 at = path->at(time_s_).position_m;
            center = step_m * glm::round(glm::dvec2(at.x, at.z) / step_m);
        }
        if (spray_center_ == center) return;
        ocean_.set_spray_center(center.x, center.y);
        constexpr double longer_than_spray_s = 600;
        if (spray_center_) ocean_.frame_at(time_s_ + (time_s_ > 0 ? -longer_than_spray_s : longer_than_spray_s));
        spray_center_ = center;
    }

    /// Returns the height of the surface in a frame, m. Small water is nearly level.
    double water_height(const Frame& frame, double x_m, double z_m) const {
        float height_m = 0;
        std::uint8_t converged = 0;
        if (options_.scene.surface == gl::Surface::open)
            SurfaceQuery(frame).sample({{&x_m, 1}, {&z_m, 1}},
                                       {.height_m = {&height_m, 1}, .converged = {&converged, 1}});
        return converged ? double{height_m} : frame.water_frame.sea_level_m;
    }

    Camera camera_in(const Frame& frame, double time_s) const {
        Camera camera = options_.scene.camera;
        if (options_.motion.path) {
            const CameraPath::Key key = options_.motion.path->at(time_s);
            camera.position_m = key.position_m;
            camera.target_m = key.target_m;
        }
        if (options_.motion.eye_height_m) {
            glm::dvec3& position = camera.position_m;
            const double height_m = water_height(frame, position.x, position.z) + *options_.motion.eye_height_m;
            if (!options_.has_target) camera.target_m.y += height_m - position.y;
            position.y = height_m;
        }
        // A path may cross that of its target.
        if (glm::distance(camera.position_m, camera.target_m) < 1e-6) camera.target_m.y -= 1;
        return camera;
    }

    /// Draws the frame's values of --aov, and returns them.
    std::vector<float> aovs_in(const Frame& frame) {
        data_->clear();
        pass_.draw({.eyes = eyes_, .mode = gl::DrawMode::surface_data});
        return aov_pixels(options_.aovs, data_->read_radiance(), eyes_[0], frame, *jobs_);
    }

    std::vector<gl::Eye> eyes_in(const Camera& camera, int width, int height) const {
        const gl::Viewport whole{0, 0, width, height};
        if (options_.stereo) return gl::eyes_of(camera, whole, eye_distance_m);
        return {gl::eye_of(camera, whole)};
    }

    /// \param weighs_samples  true: weight the samples of a pixel for display, see gl::DrawInput;
    ///     false: the samples average to true radiance
    gl::DrawStatistics draw(const std::vector<gl::Eye>& eyes, gl::RenderTarget& target, bool weighs_samples) {
        target.clear({0.004f, 0.008f, 0.016f});
        std::optional<gl::ApplicationScene> application_scene;
        if (rock_) {
            rock_->set_light(sky_, pass_.renderer().sunlit_at(*options_.rock_m));
            application_scene = rock_->image(eyes[0]);
            rock_->draw(eyes[0], weighs_samples ? exposure() : 0);
        }
        if (moment_) {
            const glm::dmat4 pose = hull_->world_from_mesh(*moment_);
            hull_mesh_->set_light(sky_, pass_.renderer().sunlit_at({pose[3].x, pose[3].z}));
            application_scene = hull_mesh_->image(eyes[0], pose);
            hull_mesh_->draw(eyes[0], pose, weighs_samples ? exposure() : 0);
        }
        return pass_.draw({.eyes = eyes,
                           .mode = options_.wireframe ? gl::DrawMode::wireframe : gl::DrawMode::shaded,
                           .exposure = exposure(),
                           .crest_glow = options_.scene.crest_glow,
                           .weighs_samples = weighs_samples,
                           .application_scene = application_scene,
                           .spray = {.droplets = droplets_}});
    }

    float exposure() const { return gl::exposure_of_ev(ev_, luminance_of_unit_); }

    /// Returns the exposure value metered for the view at time 0, whatever times are rendered.
    /// It is that of the first key of --path. So films do not flicker, and an image is identical in
    /// every run that contains it.
    float metered_ev() {
        const int width = std::min(options_.scene.width, metered_width);
        const int height = std::max(1, options_.scene.height * width / options_.scene.width);
        gl::RenderTarget small(context_.functions(), width, height, 0, gl::PixelKind::radiance);
        const Frame frame = ocean_.frame_at(0);
        pass_.upload(frame);
        const double first_s = options_.motion.path ? options_.motion.path->first_s() : 0;
        draw(eyes_in(camera_in(frame, first_s), width, height), small, true);
        gl::LightMeter meter(context_.functions());
        return gl::metered_ev(meter.measure(small.resolved()), luminance_of_unit_);
    }

    /// Tone maps the rendered image and returns RGBA8 pixels.
    std::vector<std::uint8_t> shown() {
        const gl::TexturePart radiance = target_.resolved();
        screen_->bind();
        display_->show(
            radiance,
            {.exposure = exposure(), .luminance_of_unit = luminance_of_unit_, .bloom = options_.scene.settings.bloom},
            {0, 0, options_.scene.width, options_.scene.height});
        return screen_->read();
    }

    const RenderOptions& options_;
    const gl::Sky& sky_;
    gl::HeadlessContext context_;
    Ocean ocean_;
    std::optional<EventPlayer> player_;  ///< of dynamic waves; none without --events
    gl::RenderTarget target_;
    gl::SeaPass pass_;
    std::span<const SprayDroplet> droplets_;  ///< of the frame; none when the exposure is metered
    std::optional<gl::Rock> rock_;
    std::optional<HullPlayer> hull_;
    std::optional<gl::LitMesh> hull_mesh_;
    std::optional<HullMoment> moment_;    ///< of the frame; none when the exposure is metered
    std::optional<gl::Display> display_;  ///< none for a wireframe, or without --out
    std::optional<gl::RenderTarget> screen_;
    float luminance_of_unit_, unit_, ev_ = 15;
    std::vector<std::uint8_t> pixels_;
    std::vector<float> radiance_, aovs_;
    std::optional<gl::RenderTarget> data_;  ///< none without --aov, as jobs_
    std::optional<SurfaceQueryJobs> jobs_;
    std::optional<glm::dvec2> spray_center_;
    std::vector<gl::Eye> eyes_;
    double time_s_ = 0;  ///< of the frame
    std::vector<double> sea_ms_, image_ms_;  ///< of each frame
    std::vector<gl::DrawStatistics> drawn_;
};

/// The files of one option, --out, --hdr or --spray-points; none if the option is not given.
class Files {
   public:
    Files(const RenderOptions& options, const std::filesystem::path& named) : options_(options), named_(named) {
        if (named.empty()) return;
        folder_.emplace(OutputFolder::of(named));
        folder_->check_writable(options.file_of(named, 0).filename());
    }
    void write(int frame, const std::vector<unsigned char>& bytes) const {
        folder_->write(options_.file_of(named_, frame).filename(), std::as_bytes(std::span(bytes)));
    }
    /// Returns true if the option is not given or the image exists.
    bool has(int frame) const {
        std::error_code error;
        return !folder_ || std::filesystem::is_regular_file(options_.file_of(named_, frame), error);
    }
    void sync() const {
        if (folder_) folder_->sync();
    }
    explicit operator bool() const { return folder_.has_value(); }

   private:
    const RenderOptions& options_;
    std::filesystem::path named_;
    std::optional<OutputFolder> folder_;
};

Json values(glm::vec3 v) { return Json::array({v.x, v.y, v.z}); }

/// Returns the light of a scene, except the image of the sky.
Json sky_as_json(const gl::Sky& sky) {
    return {{"sun_direction", values(sky.sun_direction)},
            {"sun_irradiance", values(sky.unit * sky.sun_irradiance)},
            {"sky_irradiance", values(sky.unit * sky.sky_irradiance)},
            {"air_extinction_per_m", values(sky.haze_per_m)},
            {"exposure", sky.exposure / sky.unit}};
}

Json water_as_json(const gl::WaterOptics& water) {
    return {{"absorption_per_m", values(water.absorption_per_m)},
            {"scattering_per_m", values(water.scattering_per_m)},
            {"backscattering_per_m", values(water.backscattering_per_m)}};
}

/// The outputs of one run.
struct Outputs {
    explicit Outputs(const RenderOptions& options)
        : images(options, options.is_film() ? std::filesystem::path() : options.file),
          hdr(options, options.hdr_file),
          spray(options, options.spray_file) {
        if (options.is_film()) {
            if (!can_make_films())
                throw bad_value("--out", options.file.string(), "*.png, or the program ffmpeg in PATH");
            film_file.emplace(options.file);
        }
        if (!options.sky_file.empty()) panorama.emplace(options.sky_file);
        if (!images && !hdr && !film_file) return;  // of --sky alone
        for (int frame = 0; frame < options.frames; ++frame)
            if (!options.resume || !images.has(frame) || !hdr.has(frame) || !spray.has(frame)) frames.push_back(frame);
    }

    Files images, hdr, spray;
    std::optional<OutputFile> film_file, panorama;
    std::vector<int> frames;  ///< to be rendered
};

/// Renders and writes all images. Returns their statistics.
Json render_images(const RenderOptions& options, const gl::Sky& sky, const Outputs& outputs, Progress& progress) {
    const int width = options.scene.width, height = options.scene.height;
    OfflineRenderer maker(options, sky, progress);
    std::optional<Film> film;
    if (outputs.film_file) film.emplace(width, height, options.fps);
    for (std::size_t done = 0; done < outputs.frames.size(); ++done) {
        const int frame = outputs.frames[done];
        progress.show(done);
        maker.draw(options.time_s + frame / options.fps);
        if (film) film->add(maker.pixels());
        const HeldStop whole_files;
        if (outputs.images) outputs.images.write(frame, encode_png(maker.pixels(), width, height));
        if (outputs.spray) outputs.spray.write(frame, spray_as_ply(maker.droplets()));
        if (outputs.hdr)
            outputs.hdr.write(frame, options.aovs.empty()
                                         ? encode_light(maker.radiance(), width, height)
                                         : encode_light(maker.radiance(), channel_names(options.aovs), maker.aovs(),
                                                        width, height));
    }
    if (film) {
        const Film::Encoded encoded = film->finish();
        if (encoded.mp4.empty()) throw FileError("can't write " + options.file.string() + ": " + encoded.reason);
        const HeldStop whole_file;
        outputs.film_file->write(std::as_bytes(std::span(encoded.mp4)));
    }
    return maker.statistics();
}

void print_render_summary(const RenderOptions& options, const Json& json, std::size_t frames) {
    if (!options.sky_file.empty())
        std::printf("%s: the sky, %dx%d\n", escaped(options.sky_file.string()).c_str(), panorama_width,
                    panorama_height);
    if (!json.contains("statistics")) {
        if (options.resume) std::printf("all %d images exist\n", options.frames);
        return;
    }
    const Json& statistics = json["statistics"];
    std::printf("%s: %zu %s%s of %dx%d, %d draw calls a view, %llu triangles, by %s\n",
                escaped(json["file"].get<std::string>()).c_str(), frames, options.is_film() ? "frame" : "image",
                frames == 1 ? "" : "s", options.scene.width, options.scene.height,
                statistics["sea_draw_calls_per_view"].get<int>(),
                static_cast<unsigned long long>(statistics["triangles"].get<std::uint64_t>()),
                statistics["renderer"].get<std::string>().c_str());
}

void run_render(const RenderOptions& options) {
    const Outputs outputs(options);
    end_on_stop_signals(options.is_film() ? "pelagic: stopped; no film was written\n"
                                          : "pelagic: stopped; the same command with --resume renders the rest\n");
    std::optional<Progress> progress(std::in_place, options.is_film() ? "frame" : "image", outputs.frames.size());
    progress->show("sky", 0);
    const gl::Stopwatch watch;
    const gl::Sky sky = baked_sky(options.scene);
    const double sky_ms = watch.milliseconds();
    if (outputs.panorama) {
        const auto exr =
            encode_light(gl::panorama_of(sky, panorama_width, panorama_height), panorama_width, panorama_height);
        const HeldStop whole_file;
        outputs.panorama->write(std::as_bytes(std::span(exr)));
    }
    Json json = {
        {"version", PELAGIC_VERSION}, {"sky", sky_as_json(sky)}, {"water", water_as_json(options.scene.water)}};
    if (!outputs.frames.empty()) {
        const std::filesystem::path& first = options.file.empty() ? options.hdr_file : options.file;
        json.update({{"file", options.file_of(first, outputs.frames.front()).string()},
                     {"width", options.scene.width},
                     {"height", options.scene.height},
                     {"quality", options.scene.quality},
                     {"sea", sea_as_json(options.scene.sea)},
                     {"weather", weather_as_json(options.scene.sea)},
                     {"statistics", render_images(options, sky, outputs, *progress)}});
        json["statistics"]["sky_ms"] = sky_ms;
    }
    progress.reset();
    outputs.images.sync();
    outputs.hdr.sync();
    outputs.spray.sync();
    if (options.json)
        std::printf("%s\n", json.dump(2).c_str());
    else if (!is_quiet())
        print_render_summary(options, json, outputs.frames.size());
}

class RenderCommand final : public Command {
   public:
    void add_options(CLI::App& app) override {
        flags_.add_to(app);
        app.footer(SceneFlags::description_of_lights());
    }
    void run() override { run_render(flags_.resolve()); }

   private:
    RenderFlags flags_;
};

}  // namespace

std::unique_ptr<Command> make_render_command() { return std::make_unique<RenderCommand>(); }

}  // namespace pelagic::tools
