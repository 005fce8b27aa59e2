// Benchmark of surface queries on one thread in points per second. Compares them with the same
// method in scalar code, and with bilinear samples without inversion, the lower bound of the cost
// of any query.
//
//   taskset -c 1 build/release/bin/pelagic_query_bench --benchmark_repetitions=9
//
// Names are what/instruction set/N/points, or what/instruction set/cascades x N/points of the
// default sea's cascades. Points are random over nine patches, or coherent: a grid of a quarter of
// a texel, as under a hull. Choppiness is 1, and the default sea's wind 12 m/s.
#include <benchmark/benchmark.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "pelagic/bench/peers/scalar_query.hpp"
#include "pelagic/sim/buffers/surface_texels.hpp"
#include "pelagic/sim/exact_water.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/sim/surface_ray.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {
namespace {

constexpr std::size_t count = 1 << 16;

SeaState one_cascade(int resolution) { return {.resolution = resolution, .patch_size_m = 250, .choppiness = 1}; }
SeaState several_cascades(int cascades) { return {.cascades = cascades, .resolution = 128, .choppiness = 1}; }

struct Scene {
    Scene(int resolution, Isa isa, bool coherent) : Scene(one_cascade(resolution), isa, coherent) {}
    Scene(const SeaState& sea, Isa isa, bool coherent)
        : ocean(sea, {.executor = make_serial_executor(), .isa = isa, .queries = true,
                      .velocities = Velocities::drawn}),
          frame(ocean.frame_at(1)),
          query(frame),
          x(count),
          z(count) {
        std::mt19937 random(1);
        const double side_m = frame.cascades[0].grid.side_m;
        std::uniform_real_distribution<double> anywhere(-side_m, 2 * side_m);
        const double spacing = frame.cascades.back().texel_m() / 4;
        for (std::size_t i = 0; i < count; ++i) {
            x[i] = coherent ? static_cast<double>(i % 256) * spacing : anywhere(random);
            z[i] = coherent ? static_cast<double>(i / 256) * spacing : anywhere(random);
        }
    }
    Ocean ocean;
    const Frame& frame;
    SurfaceQuery query;
    std::vector<double> x, z;
};

struct Wanted {
    bool normal, velocity;
    Interpolation interpolation = Interpolation::linear;
};

void time_query(benchmark::State& state, const SeaState& sea, Isa isa, bool coherent, Wanted wanted) {
    const Scene scene(sea, isa, coherent);
    const SurfaceQuery query(scene.frame, {.interpolation = wanted.interpolation});
    std::vector<std::vector<float>> out(8, std::vector<float>(count));
    SurfaceSamples samples{.height_m = out[0]};
    if (wanted.normal) samples.normal_x = out[1], samples.normal_y = out[2], samples.normal_z = out[3];
    if (wanted.velocity)
        samples.velocity_x_mps = out[4], samples.velocity_y_mps = out[5], samples.velocity_z_mps = out[6];
    for (auto _ : state) {
        query.sample({scene.x, scene.z}, samples);
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

void time_scalar(benchmark::State& state, int resolution, bool coherent) {
    const Scene scene(resolution, choose_isa(), coherent);
    for (auto _ : state)
        for (std::size_t i = 0; i < count; ++i)
            benchmark::DoNotOptimize(peers::scalar_query(scene.frame, scene.x[i], scene.z[i]));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

void time_scalar_lookup(benchmark::State& state, int resolution, bool coherent) {
    const Scene scene(resolution, choose_isa(), coherent);
    for (auto _ : state)
        for (std::size_t i = 0; i < count; ++i)
            benchmark::DoNotOptimize(peers::scalar_lookup(scene.frame, scene.x[i], scene.z[i]));
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

/// Times the kernel that samples heights at known texel positions, W at a time.
void time_lookup(benchmark::State& state, int resolution, Isa isa, bool coherent) {
    const Scene scene(resolution, isa, coherent);
    AlignedBuffer<std::int32_t> cell_x(count), cell_z(count);
    AlignedBuffer<float> u(count), v(count), height(count);
    const double texel_m = scene.frame.sea.patch_size_m / resolution;
    for (std::size_t i = 0; i < count; ++i) {
        const double x = scene.x[i] / texel_m + resolution, z = scene.z[i] / texel_m + resolution;
        cell_x[i] = static_cast<std::int32_t>(x);
        cell_z[i] = static_cast<std::int32_t>(z);
        u[i] = static_cast<float>(x - cell_x[i]);
        v[i] = static_cast<float>(z - cell_z[i]);
    }
    SampleSurfaceJob job{.surface = texels_of(scene.frame.cascades[0]),
                         .two_texels_m = 0,
                         .jacobian_factor = 0,
                         .count = count,
                         .rest = {cell_x.data(), cell_z.data(), u.data(), v.data()},
                         .out = {}};
    job.out.height = height.data();
    for (auto _ : state) {
        kernels_for(isa).sample_surface.linear(job);
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

/// Times rays from a height of 20 m, some hundred metres long.
void time_ray(benchmark::State& state, const SeaState& sea, Isa isa) {
    const Scene scene(sea, isa, false);
    std::size_t i = 0;
    for (auto _ : state) {
        i = (i + 1) % count;
        benchmark::DoNotOptimize(first_hit(scene.query, {{scene.x[i], 20, scene.z[i]}, {1, -0.1, 0.4}, 1000}));
    }
    state.SetItemsProcessed(state.iterations());
}

/// Times frames with data for queries, for comparison with the results of stages.cpp.
void time_frame(benchmark::State& state, const SeaState& sea, Isa isa, bool queries, Velocities velocities,
                bool depth) {
    Ocean ocean(sea, {.executor = make_serial_executor(), .isa = isa, .queries = queries, .velocities = velocities,
                      .depth = depth});
    double time_s = 0;
    for (auto _ : state) benchmark::DoNotOptimize(ocean.frame_at(time_s += 1.0 / 72).cascades[0].height.data);
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(ocean.cascade_count()) *
                            ocean.resolution() * ocean.resolution());
}

/// Times the exact sum at random points down to 20 m, in waves (wave vectors times points) per second.
void time_exact(benchmark::State& state, const SeaState& sea, Isa isa) {
    constexpr std::size_t points = 256;
    const ExactWater water(sea, {.isa = isa});
    std::mt19937 random(1);
    std::uniform_real_distribution<double> anywhere(-1000, 1000), depth(0, 20);
    std::vector<double> x(points), y(points), z(points);
    for (std::size_t i = 0; i < points; ++i) x[i] = anywhere(random), y[i] = 0 - depth(random), z[i] = anywhere(random);
    std::vector<std::vector<float>> out(8, std::vector<float>(points));
    const WaterSamples samples{out[0], out[1], out[2], out[3], out[4], out[5], out[6], out[7]};
    for (auto _ : state) {
        water.sample({x, y, z}, samples);
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(points * water.wave_count()));
}

/// Times ExactWater::set_time().
void time_exact_move(benchmark::State& state, const SeaState& sea, Isa isa) {
    ExactWater water(sea, {.isa = isa});
    double time_s = 0;
    for (auto _ : state) {
        water.set_time(time_s += 1.0 / 72);
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(water.wave_count()));
}

void register_queries(const SeaState& sea, const std::string& size) {
    using benchmark::RegisterBenchmark;
    for (const Isa isa : isas_here()) {
        for (const bool coherent : {false, true}) {
            const std::string suffix =
                "/" + std::string(name_of(isa)) + "/" + size + (coherent ? "/coherent" : "/random");
            const auto add = [&](const char* what, Wanted wanted) {
                RegisterBenchmark((what + suffix).c_str(), time_query, sea, isa, coherent, wanted);
            };
            add("height", {false, false});
            add("height+normal", {true, false});
            add("height+normal+velocity", {true, true});
            add("cubic/height", {false, false, Interpolation::cubic});
            add("cubic/height+normal", {true, false, Interpolation::cubic});
            add("cubic/height+normal+velocity", {true, true, Interpolation::cubic});
        }
        const std::string suffix = "/" + std::string(name_of(isa)) + "/" + size;
        const auto add_frame = [&](const char* what, bool queries, Velocities velocities, bool depth = false) {
            RegisterBenchmark((what + suffix).c_str(), time_frame, sea, isa, queries, velocities, depth)
                ->Unit(benchmark::kMicrosecond);
        };
        RegisterBenchmark(("ray" + suffix).c_str(), time_ray, sea, isa)->Unit(benchmark::kMicrosecond);
        RegisterBenchmark(("exact" + suffix).c_str(), time_exact, sea, isa)->Unit(benchmark::kMicrosecond);
        RegisterBenchmark(("exact-move" + suffix).c_str(), time_exact_move, sea, isa)->Unit(benchmark::kMicrosecond);
        add_frame("frame", false, Velocities::none);
        add_frame("frame+queries", true, Velocities::none);
        add_frame("frame+queries+velocities", true, Velocities::drawn);
        add_frame("frame+queries+water", true, Velocities::water);
        add_frame("frame+queries+depth", true, Velocities::none, true);
    }
}

void register_all() {
    using benchmark::RegisterBenchmark;
    for (const int n : {256, 512, 1024}) {
        register_queries(one_cascade(n), std::to_string(n));
        for (const bool coherent : {false, true}) {
            const std::string end = "/" + std::to_string(n) + (coherent ? "/coherent" : "/random");
            for (const Isa isa : isas_here())
                RegisterBenchmark(("lookup/" + std::string(name_of(isa)) + end).c_str(), time_lookup, n, isa,
                                  coherent);
            RegisterBenchmark(("height+normal/scalar" + end).c_str(), time_scalar, n, coherent);
            RegisterBenchmark(("lookup/scalar" + end).c_str(), time_scalar_lookup, n, coherent);
        }
    }
    for (const int cascades : {2, 3, 4})
        register_queries(several_cascades(cascades), std::to_string(cascades) + "x128");
}

}  // namespace
}  // namespace pelagic

int main(int argc, char** argv) {
    pelagic::register_all();
    benchmark::Initialize(&argc, argv);
    if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
    benchmark::RunSpecifiedBenchmarks();
    benchmark::Shutdown();
}
