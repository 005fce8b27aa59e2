// Every stage of a frame, and the whole frame, for each size and instruction set, on the calling thread.
//
//   taskset -c 1 build/release/bin/pelagic_bench --benchmark_filter='avx2/256' --benchmark_repetitions=9
//
// Names are stage/instruction set/N; items are texels, which makes sizes comparable.
#include <benchmark/benchmark.h>

#include <memory>
#include <string>

#include "sim/ocean.hpp"

namespace pelagic {
namespace {

std::unique_ptr<Ocean> ocean_of(int resolution, Isa isa) {
    SeaState sea;
    sea.resolution = resolution;
    auto ocean = std::make_unique<Ocean>(sea, OceanOptions{.executor = make_serial_executor(), .isa = isa});
    ocean->frame_at(1);
    return ocean;
}

void count_texels(benchmark::State& state, int resolution) {
    state.SetItemsProcessed(state.iterations() * resolution * resolution);
}

// A stage's jobs may be run again on what the last frame left: their work does not depend on the values.
void time_stage(benchmark::State& state, int resolution, Isa isa, std::size_t stage_number) {
    const auto ocean = ocean_of(resolution, isa);
    const Stage& stage = ocean->graph().stages()[stage_number];
    for (auto _ : state)
        for (std::size_t block = 0; block < block_count(stage); ++block) run_block(stage, block);
    count_texels(state, resolution);
}

void time_frame(benchmark::State& state, int resolution, Isa isa) {
    const auto ocean = ocean_of(resolution, isa);
    double time_s = 0;
    for (auto _ : state) benchmark::DoNotOptimize(ocean->frame_at(time_s += 1.0 / 72).height.data);
    count_texels(state, resolution);
}

void register_all() {
    for (const Isa isa : isas_here()) {
        for (int resolution = 64; resolution <= 1024; resolution *= 2) {
            std::string suffix("/");
            suffix.append(name_of(isa)).append("/").append(std::to_string(resolution));
            const auto ocean = ocean_of(resolution, isa);
            const auto stages = ocean->graph().stages();
            for (std::size_t i = 0; i < stages.size(); ++i)
                benchmark::RegisterBenchmark((stages[i].name + suffix).c_str(), time_stage, resolution, isa, i)
                    ->Unit(benchmark::kMicrosecond);
            benchmark::RegisterBenchmark(("frame" + suffix).c_str(), time_frame, resolution, isa)
                ->Unit(benchmark::kMicrosecond);
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
    benchmark::Shutdown();
}
