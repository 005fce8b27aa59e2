// Benchmark of a shore on one thread: baking, frames and queries.
//
//   taskset -c 1 build/release/bin/pelagic_shore_bench [instruction set]
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <optional>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic {
namespace {

template <class Work>
double seconds_of(Work work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median_of(std::vector<double>& values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// A beach behind an island, 1 km wide.
ShoreOptions bay(int resolution) {
    ShoreOptions shore{.columns = 201, .rows = 201, .metres_per_sample = 5, .resolution = resolution};
    for (int j = 0; j < shore.rows; ++j)
        for (int i = 0; i < shore.columns; ++i) {
            const double x = 5.0 * i, z = 5.0 * j;
            const double squared = ((x - 450) * (x - 450) + (z - 500) * (z - 500)) / 8000;
            shore.heights_m.push_back(static_cast<float>(-22 + 0.026 * x + 18 * std::exp(-squared)));
        }
    return shore;
}

void run(Isa isa) {
    constexpr int rounds = 100, points = 4096;
    std::vector<double> x, z;
    for (int i = 0; i < points; ++i) {
        x.push_back(100 + 800.0 * (i % 64) / 64);
        z.push_back(100 + 800.0 * (i / 64) / 64);
    }
    std::vector<float> height(points);
    const auto open = OceanOptions{.executor = make_serial_executor(), .isa = isa, .queries = true};
    Ocean without(SeaState{}, open);
    std::printf("texels   bake s   shore's MB   frame us   without   over it   query ns   without\n");
    for (const int resolution : {64, 128, 256, 512}) {
        OceanOptions options = open;
        options.shore = bay(resolution);
        std::optional<Ocean> with;
        const double bake_s = seconds_of([&] { with.emplace(SeaState{}, options); });
        std::vector<double> frames, frames_without, queries, queries_without;
        for (int round = 0; round < rounds; ++round) {
            const double t = 0.1 * round;
            frames.push_back(seconds_of([&] { with->frame_at(t); }));
            frames_without.push_back(seconds_of([&] { without.frame_at(t); }));
            queries.push_back(seconds_of([&] {
                SurfaceQuery(with->complete()).sample({x, z}, {.height_m = height});
            }));
            queries_without.push_back(seconds_of([&] {
                SurfaceQuery(without.complete()).sample({x, z}, {.height_m = height});
            }));
        }
        const double frame_us = 1e6 * median_of(frames), without_us = 1e6 * median_of(frames_without);
        std::printf("%6d %8.2f %12.1f %10.0f %9.0f %9.2f %10.0f %9.0f\n", resolution, bake_s,
                    static_cast<double>(with->memory_bytes() - without.memory_bytes()) / 1e6, frame_us, without_us,
                    frame_us / without_us, 1e9 * median_of(queries) / points,
                    1e9 * median_of(queries_without) / points);
    }
}

}  // namespace
}  // namespace pelagic

int main(int count, char** arguments) {
    using namespace pelagic;
    const auto asked = count > 1 ? isa_named(arguments[1]) : std::nullopt;
    run(choose_isa(asked));
}
