// Benchmark of the CPU time of a drawn frame without the driver: upload() and draw() of the OpenGL
// ES front end.
//
//   taskset -c 1 build/release/bin/pelagic_gl_bench
//
// The ocean's jobs write "mapped" frames directly into the pixel buffer; upload() copies other
// frames there. own_ms is Pelagic's time on the calling thread; a headset's frame has a budget of
// 0.3 ms for it. Draws into an offscreen target with any available EGL driver.
#include <benchmark/benchmark.h>

#include "pelagic/gl/stopwatch.hpp"
#include "pelagic/tests/gl_scene.hpp"

namespace pelagic {
namespace {

void time_frame(benchmark::State& state, const char* preset, bool stereo, bool mapped) {
    GlScene scene({.preset = preset, .resolution = 256, .width = 96, .height = 64, .samples = 1, .foam = true});
    double own_ms = 0;
    int frame = 0;
    for (auto _ : state) {
        const double x = 3.0 * frame;
        const Camera camera{.position_m = {x, 5, 0.2 * x}, .target_m = {x + 100, 0, 30}};
        const gl::Stopwatch mapping;
        const std::span<const TextureTargets> targets =
            mapped ? scene.renderer->map_textures() : std::span<const TextureTargets>();
        const double map_ms = mapped ? mapping.milliseconds() : 0;
        scene.ocean.schedule(frame++ / 90.0, targets);
        const gl::DrawStatistics& statistics = scene.draw(camera, scene.ocean.complete(), true, stereo);
        const double own = map_ms + statistics.upload_ms - statistics.upload_driver_ms + statistics.draw_ms -
                           statistics.draw_driver_ms;
        scene.gl().Finish();
        state.SetIterationTime(own / 1000);
        own_ms += own;
    }
    state.counters["own_ms"] = own_ms / static_cast<double>(state.iterations());
}

BENCHMARK_CAPTURE(time_frame, moderate_one_eye, "moderate", false, false)->UseManualTime()->Iterations(100);
BENCHMARK_CAPTURE(time_frame, moderate_one_eye_mapped, "moderate", false, true)->UseManualTime()->Iterations(100);
BENCHMARK_CAPTURE(time_frame, moderate_two_eyes, "moderate", true, false)->UseManualTime()->Iterations(100);
BENCHMARK_CAPTURE(time_frame, moderate_two_eyes_mapped, "moderate", true, true)->UseManualTime()->Iterations(100);

}  // namespace
}  // namespace pelagic

BENCHMARK_MAIN();
