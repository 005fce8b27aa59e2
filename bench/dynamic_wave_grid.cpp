// Benchmark of a tick of dynamic waves on one and two threads. Compares the spectral step with a
// frame of equal resolution, and the Verlet step with a scalar loop and with a copy
// of its inputs and outputs. Also measures grids with many boats.
//
//   build/release/bin/pelagic_dynamic_waves_bench [instruction set]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <memory>
#include <string>
#include <vector>

#include "pelagic/sim/buffers/item_stage.hpp"
#include "pelagic/sim/dynamic_waves/grid.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query_jobs.hpp"

namespace pelagic {
namespace {

constexpr int rounds = 400;

template <class Work>
double seconds_of(Work work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median_us(std::vector<double>& seconds) {
    std::nth_element(seconds.begin(), seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2),
                     seconds.end());
    return 1e6 * seconds[seconds.size() / 2];
}

struct Waves {
    Waves(const DynamicWavesOptions& options, Isa isa, Executor& executor) : grid(options, isa) {
        grid.add_tick_stages(graph);
        run = executor.prepare(graph);
    }
    void begin() {
        grid.begin_tick();
        run->schedule();
    }
    void end() {
        run->complete();
        grid.end_tick();
    }
    DynamicWaveGrid grid;
    JobGraph graph;
    std::unique_ptr<GraphRun> run;
};

/// The Verlet step as a plain loop without vectorisation.
__attribute__((optimize("no-tree-vectorize"))) void scalar_verlet(const VerletRowsJob& job) {
    const auto [now, before, n, first_row, rows, coupling, damping] = job;
    const std::size_t stride = dynamic_row_stride(n);
    for (std::size_t z = first_row; z < first_row + rows; ++z) {
        const float *row = now + z * stride, *above = now + (z + n - 1) % n * stride,
                    *below = now + (z + 1) % n * stride;
        float* const to = before + z * stride;
        for (std::size_t x = 0; x < n; ++x)
            to[x] = row[x] + (damping * (row[x] - to[x]) +
                              coupling * (row[x - 1] + row[x + 1] + (above[x] + below[x]) - 4 * row[x]));
    }
}

/// A stage whose items are rows, as in the jobs of a tick.
class RowsStage {
   public:
    template <class OfRows>
    RowsStage(std::size_t n, Executor& executor, OfRows of_rows) {
        graph_.add(
            {.name = "rows",
             .count = n / DynamicWaveGrid::rows_per_item,
             .body = for_each_item([of_rows](std::size_t item) { of_rows(item * DynamicWaveGrid::rows_per_item); })});
        run_ = executor.prepare(graph_);
    }
    void operator()() {
        run_->schedule();
        run_->complete();
    }

   private:
    JobGraph graph_;
    std::unique_ptr<GraphRun> run_;
};

std::shared_ptr<Executor> executor_of(int threads) {
    return threads == 1 ? make_serial_executor() : make_thread_executor(threads);
}

void measure_steps(std::size_t n, Isa isa, int threads) {
    const auto executor = executor_of(threads);
    const double side_m = 0.25 * static_cast<double>(n);
    const int resolution = static_cast<int>(n);
    Waves spectral({.resolution = resolution, .side_m = side_m, .border_m = side_m / 5}, isa, *executor);
    Waves verlet(
        {.step = DynamicWavesStep::verlet, .resolution = resolution, .side_m = side_m, .border_m = side_m / 5}, isa,
        *executor);
    Ocean ocean({.resolution = resolution, .patch_size_m = side_m}, {.executor = executor, .isa = isa});
    const Kernels& kernels = kernels_for(isa);
    AlignedBuffer<float> now(dynamic_plane_floats(n)), before(dynamic_plane_floats(n));
    for (std::size_t i = 0; i < now.size(); ++i) now[i] = before[i] = std::sin(0.01f * static_cast<float>(i));
    const auto rows_from = [&, n](std::size_t row) -> VerletRowsJob {
        return {now.data() + dynamic_row_margin,
                before.data() + dynamic_row_margin,
                n,
                row,
                DynamicWaveGrid::rows_per_item,
                0.1f,
                0.9999f};
    };
    RowsStage step(n, *executor, [&](std::size_t row) { kernels.verlet_rows(rows_from(row)); });
    RowsStage scalar(n, *executor, [&](std::size_t row) { scalar_verlet(rows_from(row)); });
    const std::size_t floats = DynamicWaveGrid::rows_per_item * dynamic_row_stride(n);
    RowsStage copy(n, *executor, [&](std::size_t row) {
        const std::size_t at = row * dynamic_row_stride(n);
        std::memcpy(before.data() + at, now.data() + at, floats * sizeof(float));
    });

    std::vector<double> of_frame, of_spectral, of_verlet, of_step, of_scalar, of_copy;
    for (int round = 0; round < rounds; ++round) {
        spectral.grid.sources().add_impulse({.mode = Disturbance::Mode::relaxation, .radius_m = 2, .height_m = 0.3});
        verlet.grid.sources().add_impulse({.mode = Disturbance::Mode::relaxation, .radius_m = 2, .height_m = 0.3});
        of_frame.push_back(seconds_of([&] { ocean.frame_at(round / 72.0); }));
        of_spectral.push_back(seconds_of([&] { spectral.begin(), spectral.end(); }));
        of_verlet.push_back(seconds_of([&] { verlet.begin(), verlet.end(); }));
        of_step.push_back(seconds_of([&] { step(); }));
        of_scalar.push_back(seconds_of([&] { scalar(); }));
        // 1.5 times a copy: the step reads two planes and writes one.
        of_copy.push_back(1.5 * seconds_of([&] { copy(); }));
    }
    const double frame = median_us(of_frame), spectral_tick = median_us(of_spectral), of_one = median_us(of_step),
                 copied = median_us(of_copy), without_lanes = median_us(of_scalar);
    std::printf("%5zu %7d %9.1f %9.1f (%.2f) %9.1f %9.1f %9.1f (%.1f) %9.1f (%.2f)\n", n, threads, frame,
                spectral_tick, spectral_tick / frame, median_us(of_verlet), of_one, without_lanes,
                without_lanes / of_one, copied, of_one / copied);
}

/// Measures four shared grids with 250 boats each; a boat queries the grid's height at 12
/// positions.
void measure_server(Isa isa, int threads) {
    const auto executor = executor_of(threads);
    std::vector<std::unique_ptr<Waves>> waves;
    for (int i = 0; i < 4; ++i) waves.push_back(std::make_unique<Waves>(DynamicWavesOptions{}, isa, *executor));
    std::vector<double> ticks;
    for (int tick = 0; tick < rounds / 2; ++tick) {
        ticks.push_back(seconds_of([&] {
            for (auto& each : waves) {
                for (int boat = 0; boat < 250; ++boat)
                    each->grid.sources().add_impulse({.shape = Disturbance::Shape::hull,
                                                      .x_m = 25 * std::sin(0.37 * boat + 0.01 * tick),
                                                      .z_m = 25 * std::cos(0.73 * boat),
                                                      .radius_m = 0.8,
                                                      .length_m = 2,
                                                      .heading_rad = 0.01 * boat,
                                                      .height_m = -0.3});
                each->begin();
            }
            for (auto& each : waves) each->end();
        }));
    }
    std::printf("four grids of 256 with 250 hulls each, %d thread%s: %.2f ms a tick\n", threads,
                threads == 1 ? "" : "s", median_us(ticks) / 1000);
}

/// Measures a server's tick of the default sea: a frame, then heights, normals and velocities at 12
/// points of each of 1,000 boats.
void measure_queries(Isa isa, int threads) {
    const auto executor = executor_of(threads);
    Ocean ocean(SeaState{}, {.executor = executor, .isa = isa, .queries = true, .velocities = Velocities::drawn});
    SurfaceQueryJobs jobs(executor);
    constexpr std::size_t count = 12 * 1000;
    std::vector<double> x(count), z(count), ticks;
    for (std::size_t i = 0; i < count; ++i) {
        const auto boat = static_cast<double>(i / 12), point = static_cast<double>(i % 12);
        x[i] = 400 * std::sin(0.37 * boat) + point, z[i] = 400 * std::cos(0.73 * boat) + 0.5 * point;
    }
    std::vector<float> height(count), normal_x(count), normal_y(count), normal_z(count), vertical_velocity(count);
    for (int tick = 0; tick < rounds / 2; ++tick)
        ticks.push_back(seconds_of([&] {
            const SurfaceQuery query(ocean.frame_at(tick / 30.0));
            jobs.sample(query, {x, z},
                        {.height_m = height,
                         .normal_x = normal_x,
                         .normal_y = normal_y,
                         .normal_z = normal_z,
                         .velocity_y_mps = vertical_velocity});
        }));
    std::printf("a frame of the default sea and 12 points of each of 1,000 boats, %d thread%s: %.2f ms\n", threads,
                threads == 1 ? "" : "s", median_us(ticks) / 1000);
}

}  // namespace
}  // namespace pelagic

int main(int argc, char** argv) {
    const auto wanted = argc > 1 ? pelagic::isa_named(argv[1]) : std::nullopt;
    const pelagic::Isa isa = pelagic::choose_isa(wanted);
    std::printf(
        "%s; microseconds, medians; in brackets how much more than what stands before, and the step than the copy\n",
        std::string(name_of(isa)).c_str());
    std::printf("    N threads     frame    spectral tick Verlet tick its step   without lanes      bytes copied\n");
    for (const int threads : {1, 2}) {
        for (const std::size_t n : {64, 128, 256, 512}) pelagic::measure_steps(n, isa, threads);
        pelagic::measure_queries(isa, threads);
        pelagic::measure_server(isa, threads);
    }
}
