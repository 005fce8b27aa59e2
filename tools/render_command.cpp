#include "pelagic/tools/render_command.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <vector>

#include "pelagic/gl/headless_context.hpp"
#include "pelagic/gl/render_target.hpp"
#include "pelagic/gl/sea_renderer.hpp"
#include "pelagic/gl/stopwatch.hpp"
#include "pelagic/quadtree/selection.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/image_writer.hpp"
#include "pelagic/tools/output_folder.hpp"
#include "pelagic/tools/progress.hpp"
#include "pelagic/tools/sea_json.hpp"

namespace pelagic::tools {
namespace {

constexpr int samples_a_pixel = 4;
/// A texel of the sky is then 0.18 degrees wide, about three pixels of the usual picture.
constexpr int sky_face_size = 512;
/// Between the eyes of most people (Dodgson 2004: 63 mm in the mean).
constexpr double eye_distance_m = 0.063;

double median(std::vector<double> values) {
    std::nth_element(values.begin(), values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2), values.end());
    return values[values.size() / 2];
}

/// Times of each frame, and what the last one drew.
struct Measured {
    std::vector<double> sea_ms, select_ms, upload_ms, upload_driver_ms, draw_ms, draw_driver_ms, picture_ms;
    gl::DrawFigures last;
};

/// Everything that a picture needs, built once.
class PictureMaker {
   public:
    explicit PictureMaker(const RenderOptions& options)
        : options_(options),
          ocean_(options.scene.sea.sea, {.executor = make_default_executor(options.scene.compute.threads),
                                         .isa = options.scene.compute.isa,
                                         .slopes = true}),
          target_(context_.functions(), options.scene.width, options.scene.height, samples_a_pixel),
          renderer_(context_.functions(), {.patch_vertices = options.scene.quadtree.vertices,
                                           .resolution = ocean_.resolution(),
                                           .tiles = ocean_.tile_count(),
                                           .surface = options.scene.surface,
                                           .executor = make_default_executor(options.scene.compute.threads)}),
          selection_(options.scene.quadtree) {
        const gl::Stopwatch watch;
        gl::SkyBaker baker(make_default_executor(options.scene.compute.threads), sky_face_size);
        baker.schedule(options.scene.sky);
        renderer_.set_sky(baker.complete());
        renderer_.set_water(options.scene.water);
        sky_ms_ = watch.milliseconds();

        if (options.scene.flow) renderer_.set_flow(*options.scene.flow);

        const gl::Viewport whole{0, 0, options.scene.width, options.scene.height};
        if (options.stereo) {
            const gl::EyePair pair = gl::eyes_of(options.scene.camera, whole, eye_distance_m);
            eyes_ = {pair.left, pair.right};
        } else {
            eyes_ = {gl::eye_of(options.scene.camera, whole)};
        }
        for (const gl::Eye& eye : eyes_) views_.push_back(eye.clip_from_world);
    }

    std::vector<std::uint8_t> picture(double time_s) {
        const gl::Stopwatch all;
        const Frame& frame = ocean_.frame_at(time_s);
        measured_.sea_ms.push_back(all.milliseconds());

        const gl::Stopwatch select;
        const DrawList& list = selection_.select(
            {.viewer_m = options_.scene.camera.position_m, .views = views_, .bounds = frame.bounds});
        measured_.select_ms.push_back(select.milliseconds());

        const gl::Functions& functions = context_.functions();
        target_.bind();
        functions.ClearColor(0.004f, 0.008f, 0.016f, 1);
        functions.Clear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
        renderer_.upload(frame);
        const gl::DrawFigures& figures =
            renderer_.draw({.eyes = eyes_,
                            .viewer_m = options_.scene.camera.position_m,
                            .list = &list,
                            .lod_scale = options_.scene.quadtree.lod_scale,
                            .mode = options_.wireframe ? gl::DrawMode::wireframe : gl::DrawMode::shaded});
        measured_.upload_ms.push_back(figures.upload_ms);
        measured_.upload_driver_ms.push_back(figures.upload_driver_ms);
        measured_.draw_ms.push_back(figures.draw_ms);
        measured_.draw_driver_ms.push_back(figures.draw_driver_ms);
        measured_.last = figures;
        std::vector<std::uint8_t> pixels = target_.read();
        measured_.picture_ms.push_back(all.milliseconds());
        return pixels;
    }

    Json figures() const {
        const gl::DrawFigures& last = measured_.last;
        const auto views = static_cast<int>(eyes_.size());
        return {{"renderer", context_.renderer_name()},
                {"frames", measured_.sea_ms.size()},
                {"views", views},
                {"sea_draw_calls", last.sea_calls},
                {"sea_draw_calls_a_view", last.sea_calls / views},
                {"sky_draw_calls", last.sky_calls},
                {"triangles", last.triangles},
                {"patches", selection_.list().instances.size()},
                {"uploaded_bytes", last.upload_bytes},
                {"instance_bytes", last.instance_bytes},
                {"median_ms",
                 {{"sea", median(measured_.sea_ms)},
                  {"select", median(measured_.select_ms)},
                  {"upload", median(measured_.upload_ms)},
                  {"upload_in_driver", median(measured_.upload_driver_ms)},
                  {"draw", median(measured_.draw_ms)},
                  {"draw_in_driver", median(measured_.draw_driver_ms)},
                  {"picture", median(measured_.picture_ms)}}},
                {"sky_ms", sky_ms_}};
    }

   private:
    const RenderOptions& options_;
    gl::HeadlessContext context_;
    Ocean ocean_;
    gl::RenderTarget target_;
    gl::SeaRenderer renderer_;
    Selection selection_;
    std::vector<gl::Eye> eyes_;
    std::vector<glm::dmat4> views_;
    double sky_ms_ = 0;
    Measured measured_;
};

}  // namespace

void run_render(const RenderOptions& options) {
    const OutputFolder folder = OutputFolder::of(options.file);
    folder.check_writable(options.file_of(0).filename());
    PictureMaker maker(options);
    {
        Progress progress("picture", static_cast<std::size_t>(options.frames));
        for (int frame = 0; frame < options.frames; ++frame) {
            progress.show(static_cast<std::size_t>(frame));
            const std::vector<std::uint8_t> pixels = maker.picture(options.time_s + frame / options.fps);
            const std::vector<unsigned char> png = encode_picture(pixels, options.scene.width, options.scene.height);
            folder.write(options.file_of(frame).filename(), std::as_bytes(std::span(png)));
        }
    }
    folder.sync();
    Json json = {{"version", PELAGIC_VERSION},       {"file", options.file_of(0).string()},
                 {"width", options.scene.width},     {"height", options.scene.height},
                 {"quality", options.scene.quality}, {"sea", sea_as_json(options.scene.sea)},
                 {"figures", maker.figures()}};
    if (options.json) {
        std::printf("%s\n", json.dump(2).c_str());
        return;
    }
    const Json& figures = json["figures"];
    std::printf("%s: %d picture%s of %dx%d, %d draw calls a view, %llu triangles, by %s\n",
                options.file_of(0).c_str(), options.frames, options.frames == 1 ? "" : "s", options.scene.width,
                options.scene.height, figures["sea_draw_calls_a_view"].get<int>(),
                static_cast<unsigned long long>(figures["triangles"].get<std::uint64_t>()),
                figures["renderer"].get<std::string>().c_str());
}

}  // namespace pelagic::tools
