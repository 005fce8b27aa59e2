// The sea in a headset with OpenXR and OpenGL ES:
//
//   openxr_application [--preset NAME] [--resolution N] [--quality NAME] [--frames N]
//                      [--images FOLDER] [--hashes FILE]
//
// This file contains the frame loop. The other files contain functions that an engine usually
// provides. See docs/integrations/vr.md.
#include <algorithm>
#include <array>
#include <cinttypes>
#include <cstdio>
#include <exception>
#include <optional>
#include <string>

#include "egl_context.hpp"
#include "eye_images.hpp"
#include "headset.hpp"
#include "image.hpp"
#include "options.hpp"
#include "sea_scene.hpp"
#include "whole_file.hpp"

namespace {

using namespace openxr_application;

/// The projection layer of both eyes for the compositor, with the poses of rendering.
struct EyesLayer {
    std::array<XrCompositionLayerProjectionView, 2> views{};
    XrCompositionLayerProjection layer{.type = XR_TYPE_COMPOSITION_LAYER_PROJECTION};

    EyesLayer(XrSpace space, const std::array<XrView, 2>& eyes, const EyeImages& images) {
        for (std::size_t eye = 0; eye < 2; ++eye)
            views[eye] = {.type = XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW,
                          .pose = eyes[eye].pose,
                          .fov = eyes[eye].fov,
                          .subImage = images.sub_image(eye)};
        layer.space = space;
        layer.viewCount = 2;
        layer.views = views.data();
    }
    EyesLayer(const EyesLayer&) = delete;
    EyesLayer& operator=(const EyesLayer&) = delete;
};

/// Escapes line ends, which values of options and messages of drivers may contain.
std::string one_line(std::string text) {
    std::replace_if(
        text.begin(), text.end(), [](unsigned char c) { return c < ' '; }, '?');
    return text;
}

/// Returns the time and the hash of a frame, which are identical on every machine.
std::string hash_line(const pelagic::Frame& frame) {
    std::array<char, 64> line;
    std::snprintf(line.data(), line.size(), "%.9f %016" PRIx64 "\n", frame.time_s, pelagic::hash_of(frame));
    return line.data();
}

void save_images(const EyeImages& images, const std::filesystem::path& folder) {
    write_image(folder / "left.ppm", images.read(0), images.width(), images.height());
    write_image(folder / "right.ppm", images.read(1), images.width(), images.height());
}

void run(const Options& options) {
    const bool is_hashed = !options.hashes.empty();
    const EglContext context;  // outlives the session, which uses it
    const pelagic::gl::Functions gl = pelagic::gl::load_functions(
        [](const char* name) { return reinterpret_cast<void*>(eglGetProcAddress(name)); });
    Headset headset;
    SeaScene scene(options.sea, options.quality, gl, EyeImages::has_multiview(gl));
    headset.start(context.binding());
    EyeImages images(headset, gl);

    XrTime start = 0;
    int shown = 0;
    std::string hashes;
    while (headset.is_wanted()) {
        if (!headset.handle_events()) continue;

        // The runtime blocks this thread and returns the predicted display time. Other threads
        // compute the sea of that time, while this thread begins the frame, locates the eyes, waits
        // for an image, and does other work of a game. No sea is computed for frames that are not
        // displayed.
        const XrFrameState moment = headset.wait_frame();
        if (start == 0) start = moment.predictedDisplayTime;
        const double sea_time_s = static_cast<double>(moment.predictedDisplayTime - start) * 1e-9;
        if (moment.shouldRender) scene.schedule(sea_time_s, is_hashed);

        headset.begin_frame();
        std::optional<std::array<XrView, 2>> eyes;
        if (moment.shouldRender) {
            eyes = headset.locate_eyes(moment.predictedDisplayTime);
            if (eyes) images.acquire();
            scene.complete();  // the sea is needed now
        }
        if (!eyes) {
            headset.end_frame(moment.predictedDisplayTime, nullptr);
            continue;
        }
        scene.draw(*eyes, images);
        ++shown;
        const bool is_last = shown == options.frames;
        if (is_hashed) hashes += hash_line(scene.frame());
        if (is_last && !options.images.empty()) save_images(images, options.images);
        images.release();
        const EyesLayer layer(headset.space(), *eyes, images);
        headset.end_frame(moment.predictedDisplayTime, &layer.layer);
        if (is_last) headset.request_exit();
    }
    if (is_hashed) write_whole_file(options.hashes, hashes);
    std::printf("%d frames shown, %d x %d an eye, %s\n", shown, images.width(), images.height(),
                images.is_multiview() ? "both in one pass" : "a pass for each");
}

}  // namespace

int main(int count, char** arguments) {
    try {
        run(options_of(count, arguments));
        return 0;
    } catch (const std::exception& error) {
        std::fprintf(stderr, "openxr_application: %s\n", one_line(error.what()).c_str());
        return 1;
    }
}
