// Benchmark of analytic waves on one thread, in points per second.
//
//   taskset -c 1 build/release/bin/pelagic_analytic_bench --benchmark_repetitions=9
//
// Names are what/results/instruction set/waves. `rest` queries reference positions, `world`
// displaced positions within 1e-4 m. 16 waves are the preset analytic-moderate, or analytic-intense
// for `intense`. Points are random over a square kilometre.
#include <benchmark/benchmark.h>

#include <memory>
#include <random>
#include <string>
#include <vector>

#include "pelagic/analytic/analytic_surface.hpp"
#include "pelagic/analytic/pond_waves.hpp"

namespace pelagic {
namespace {

constexpr std::size_t count = 1 << 14;

struct Scene {
    Scene() : x(count), z(count), out(10, std::vector<float>(count)) {
        std::mt19937 random(1);
        std::uniform_real_distribution<double> anywhere(-500, 500);
        for (double& at : x) at = anywhere(random);
        for (double& at : z) at = anywhere(random);
    }
    std::vector<double> x, z;
    std::vector<std::vector<float>> out;
};

enum class Wanted { height, normal, everything };
constexpr const char* wanted_names[] = {"height", "height+normal", "height+normal+velocity"};

AnalyticSamples samples_in(Scene& scene, Wanted wanted) {
    auto& out = scene.out;
    AnalyticSamples samples{.height_m = out[0]};
    if (wanted != Wanted::height) samples.normal_x = out[1], samples.normal_y = out[2], samples.normal_z = out[3];
    if (wanted == Wanted::everything)
        samples.velocity_x_mps = out[4], samples.velocity_y_mps = out[5], samples.velocity_z_mps = out[6];
    return samples;
}

/// Returns the first waves of a preset, or all of its waves four times with a quarter of the
/// height.
AnalyticSea sea_of(const char* preset, std::size_t waves) {
    AnalyticSea sea = analytic_preset_named(preset)->sea;
    if (waves == 64) {
        for (AnalyticWave& wave : sea.waves) wave.amplitude_m /= 4;
        for (std::size_t i = 16; i < 64; ++i) {
            sea.waves.push_back(sea.waves[i - 16]);
            sea.waves.back().direction_rad += 0.3;
        }
    }
    sea.waves.resize(waves);
    return sea;
}

void time_surface(benchmark::State& state, const AnalyticSea& sea, Isa isa, bool in_world, Wanted wanted) {
    Scene scene;
    const AnalyticSurface water(sea, isa);
    const AnalyticSamples samples = samples_in(scene, wanted);
    double time_s = 0;
    for (auto _ : state) {
        if (in_world)
            water.sample(time_s += 1.0 / 72, {scene.x, scene.z}, samples);
        else
            water.sample_undisplaced(time_s += 1.0 / 72, {scene.x, scene.z}, samples);
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

void time_pond(benchmark::State& state, Isa isa, Wanted wanted) {
    Scene scene;
    const PondWaves water({}, isa);
    const AnalyticSamples of = samples_in(scene, wanted);
    double time_s = 0;
    for (auto _ : state) {
        water.sample(time_s += 1.0 / 72, {scene.x, scene.z}, {of.height_m, of.normal_x, of.normal_y, of.normal_z});
        benchmark::ClobberMemory();
    }
    state.SetItemsProcessed(state.iterations() * static_cast<std::int64_t>(count));
}

void time_pond_ray(benchmark::State& state, Isa isa) {
    const Scene scene;
    const PondWaves water({}, isa);
    std::size_t i = 0;
    for (auto _ : state) {
        i = (i + 1) % count;
        benchmark::DoNotOptimize(water.first_hit(1, {scene.x[i], 1.7, scene.z[i]}, {1, -0.3, 0.4}, 100));
    }
    state.SetItemsProcessed(state.iterations());
}

void register_all() {
    using benchmark::RegisterBenchmark;
    for (const Isa isa : isas_here()) {
        const std::string on = "/" + std::string(name_of(isa)) + "/";
        for (const Wanted wanted : {Wanted::height, Wanted::normal, Wanted::everything}) {
            const std::string what = wanted_names[static_cast<int>(wanted)];
            for (const std::size_t waves : {4, 16, 64})
                for (const bool in_world : {false, true})
                    RegisterBenchmark(((in_world ? "world/" : "rest/") + what + on + std::to_string(waves)).c_str(),
                                      time_surface, sea_of("analytic-moderate", waves), isa, in_world, wanted);
            RegisterBenchmark(("world/" + what + on + "intense").c_str(), time_surface,
                              sea_of("analytic-intense", 16), isa, true, wanted);
            if (wanted != Wanted::everything)
                RegisterBenchmark(("pond/" + what + on + "24").c_str(), time_pond, isa, wanted);
        }
        RegisterBenchmark(("pond/ray" + on + "24").c_str(), time_pond_ray, isa)->Unit(benchmark::kMicrosecond);
    }
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
