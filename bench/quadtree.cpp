// Benchmark of the selection of patches: Pelagic's traversal and the paper's full traversal, by
// size of the sea.
//
//   taskset -c 1 build/release/bin/pelagic_quadtree_bench
//
// Names are selection/preset/S, stereo/preset/S and paper/preset/S; items are drawn patches.
#include <benchmark/benchmark.h>

#include <array>
#include <cmath>
#include <glm/ext/matrix_clip_space.hpp>
#include <glm/ext/matrix_transform.hpp>
#include <string>

#include "pelagic/bench/peers/paper_quadtree.hpp"
#include "pelagic/quadtree/selection.hpp"

namespace pelagic {
namespace {

constexpr FrameBounds moderate_sea{-2, 2.5, 1.5, 1.5};

/// Returns the view of a viewer on board with a heading that changes each time.
glm::dmat4 view_of(glm::dvec3 eye, double heading) {
    const glm::dvec3 ahead(std::cos(heading), -0.1, std::sin(heading));
    return glm::infinitePerspectiveRH(1.4, 1.0, 0.1) * glm::lookAtRH(eye, eye + ahead, glm::dvec3(0, 1, 0));
}

/// Returns a position on a circle of 100 m diameter, so that levels change.
glm::dvec3 on_board(double heading) { return {50 * std::cos(heading), 2, 50 * std::sin(heading)}; }

void time_selection(benchmark::State& state, const QuadtreePreset& preset, double size_m, std::size_t eyes) {
    Selection selection(preset.options(size_m));
    double heading = 0;
    std::int64_t patches = 0, visited = 0;
    for (auto _ : state) {
        heading += 0.01;
        const glm::dvec3 viewer = on_board(heading);
        const std::array<glm::dmat4, 2> views = {view_of(viewer, heading),
                                                 view_of(viewer + glm::dvec3(0.06, 0, 0), heading)};
        const DrawList& list = selection.select({.viewer_m = viewer,
                                                 .views = std::span(views).first(eyes),
                                                 .bounds = moderate_sea,
                                                 .depth = ClipDepth::minus_one_to_one});
        benchmark::DoNotOptimize(list.instances.data());
        patches += static_cast<std::int64_t>(list.instances.size());
        visited += list.statistics.nodes_visited;
    }
    state.SetItemsProcessed(patches);
    state.counters["patches"] = static_cast<double>(patches) / static_cast<double>(state.iterations());
    state.counters["visited"] = static_cast<double>(visited) / static_cast<double>(state.iterations());
}

void time_paper(benchmark::State& state, const QuadtreePreset& preset, double size_m) {
    // The frame's height, as for Selection, so that both cull similarly.
    peers::PaperQuadtree quadtree({.size_m = size_m, .lod_scale = preset.lod_scale, .height_max_m = 5});
    double heading = 0;
    std::int64_t patches = 0;
    for (auto _ : state) {
        heading += 0.01;
        const glm::dvec3 viewer = on_board(heading);
        const auto& list = quadtree.select(viewer, Frustum(view_of(viewer, heading), ClipDepth::minus_one_to_one));
        benchmark::DoNotOptimize(list.data());
        patches += static_cast<std::int64_t>(list.size());
    }
    state.SetItemsProcessed(patches);
    state.counters["patches"] = static_cast<double>(patches) / static_cast<double>(state.iterations());
    state.counters["visited"] = quadtree.nodes_visited();
}

void register_all() {
    for (const char* name : {"medium", "paper_medium"}) {
        const QuadtreePreset& preset = *quadtree_preset_named(name);
        for (const double size : {512.0, 2048.0, 8192.0}) {
            const std::string suffix = std::string("/") + name + "/" + std::to_string(static_cast<int>(size));
            benchmark::RegisterBenchmark(("selection" + suffix).c_str(), time_selection, preset, size, 1);
            benchmark::RegisterBenchmark(("stereo" + suffix).c_str(), time_selection, preset, size, 2);
            benchmark::RegisterBenchmark(("paper" + suffix).c_str(), time_paper, preset, size);
        }
    }
}

}  // namespace
}  // namespace pelagic

int main(int argc, char** argv) {
    pelagic::register_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
}
