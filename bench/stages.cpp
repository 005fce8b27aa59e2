// Benchmark of each job of a frame, of whole frames on one and several threads, and of the
// machine's upper bounds.
//
//   taskset -c 1 build/release/bin/pelagic_bench --benchmark_filter='avx2/256'
//     --benchmark_repetitions=9
//
// Names are stage/instruction set/N, frame/instruction set/N/threads, ceiling/instruction set/what.
// Items are texels, so that sizes are comparable. FLOP/s and B/s are a stage's nominal work divided
// by its time; ceilings are upper bounds of one core.
#include <benchmark/benchmark.h>

#include <map>
#include <memory>
#include <string>

#include "pelagic/bench/ceilings.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/simd/aligned_buffer.hpp"
#include "pelagic/tools/benchmark/stage_work.hpp"

namespace pelagic {
namespace {

std::unique_ptr<Ocean> ocean_of(int resolution, Isa isa, std::shared_ptr<Executor> executor) {
    SeaState sea;
    sea.resolution = resolution;
    sea.patch_size_m = 250;
    auto ocean = std::make_unique<Ocean>(sea, OceanOptions{.executor = std::move(executor), .isa = isa});
    ocean->frame_at(1);
    return ocean;
}

tools::FrameShape shape_of(Ocean& ocean) {
    return {1, ocean.resolution(), ocean.complete().cascades[0].height.block_columns};
}

void count(benchmark::State& state, int resolution, tools::StageWork work) {
    const double texels = static_cast<double>(resolution) * resolution;
    state.SetItemsProcessed(state.iterations() * resolution * resolution);
    state.counters["FLOP/s"] = benchmark::Counter(texels * work.flops, benchmark::Counter::kIsIterationInvariantRate);
    state.counters["B/s"] = benchmark::Counter(texels * work.bytes, benchmark::Counter::kIsIterationInvariantRate);
}

// A stage's jobs run again on the data of the last frame, because their work does not depend on the
// values.
void time_stage(benchmark::State& state, int resolution, Isa isa, std::size_t stage_number) {
    const auto ocean = ocean_of(resolution, isa, make_serial_executor());
    const Stage& stage = ocean->graph().stages()[stage_number];
    for (auto _ : state)
        for (std::size_t block = 0; block < block_count(stage); ++block) run_block(stage, block);
    count(state, resolution, tools::work_of(stage.name, shape_of(*ocean)));
}

/// One thread is a direct call, without a job system.
void time_frame(benchmark::State& state, int resolution, Isa isa, int threads) {
    const auto ocean =
        ocean_of(resolution, isa, threads == 1 ? make_serial_executor() : make_default_executor(threads));
    double time_s = 0;
    for (auto _ : state) benchmark::DoNotOptimize(ocean->frame_at(time_s += 1.0 / 72).cascades[0].height.data);
    tools::StageWork work{};
    for (const Stage& stage : ocean->graph().stages()) {
        const tools::StageWork of_stage = tools::work_of(stage.name, shape_of(*ocean));
        work.flops += of_stage.flops;
        work.bytes += of_stage.bytes;
    }
    count(state, resolution, work);
}

/// Times cascades that are planned for the sea.
void time_stack(benchmark::State& state, int cascades, Isa isa, int threads) {
    Ocean ocean({.cascades = cascades, .resolution = 128},
                {.executor = threads == 1 ? make_serial_executor() : make_default_executor(threads), .isa = isa});
    double time_s = 0;
    for (auto _ : state) benchmark::DoNotOptimize(ocean.frame_at(time_s += 1.0 / 72).cascades[0].height.data);
    state.SetItemsProcessed(state.iterations() * cascades * 128 * 128);
    state.counters["memory"] = static_cast<double>(ocean.memory_bytes());
}

void time_arithmetic(benchmark::State& state, Isa isa) {
    double flops = 0;
    for (auto _ : state) flops += bench::run_arithmetic(isa, 10000);
    state.counters["FLOP/s"] = benchmark::Counter(flops, benchmark::Counter::kIsRate);
}

void time_copy(benchmark::State& state, Isa isa, std::size_t bytes) {
    const std::size_t floats = bytes / 2 / sizeof(float);
    AlignedBuffer<float> from(floats), to(floats);
    double copied = 0;
    for (auto _ : state) copied += bench::run_copy(isa, from.data(), to.data(), floats, 1 + (1 << 20) / floats);
    state.counters["B/s"] = benchmark::Counter(copied, benchmark::Counter::kIsRate);
}

void register_all() {
    using benchmark::RegisterBenchmark;
    const int cores = default_thread_count();
    for (const Isa isa : isas_here()) {
        const std::string name(name_of(isa));
        RegisterBenchmark(("ceiling/" + name + "/add_and_multiply").c_str(), time_arithmetic, isa);
        for (const auto& [place, kib] : std::map<std::string, std::size_t>{
                 {"copy_16KiB", 16}, {"copy_256KiB", 256}, {"copy_8MiB", 8192}, {"copy_256MiB", 262144}})
            RegisterBenchmark(("ceiling/" + name + "/" + place).c_str(), time_copy, isa, kib * 1024);
        for (const int cascades : {3, 4})
            for (int threads = 1; threads <= cores; threads *= 2)
                RegisterBenchmark(
                    ("frame/" + name + "/" + std::to_string(cascades) + "x128/" + std::to_string(threads)).c_str(),
                    time_stack, cascades, isa, threads)
                    ->Unit(benchmark::kMicrosecond)
                    ->UseRealTime();
        for (int n = 64; n <= 1024; n *= 2) {
            const std::string suffix = "/" + name + "/" + std::to_string(n);
            const auto ocean = ocean_of(n, isa, make_serial_executor());
            const auto stages = ocean->graph().stages();
            for (std::size_t i = 0; i < stages.size(); ++i)
                RegisterBenchmark((stages[i].name + suffix).c_str(), time_stage, n, isa, i)
                    ->Unit(benchmark::kMicrosecond);
            for (int threads = 1; threads <= cores; threads *= 2)
                RegisterBenchmark(("frame" + suffix + "/" + std::to_string(threads)).c_str(), time_frame, n, isa,
                                  threads)
                    ->Unit(benchmark::kMicrosecond)
                    ->UseRealTime();
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
