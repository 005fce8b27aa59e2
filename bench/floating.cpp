// Benchmark of a tick of 1,000 hulls on the default sea, on one and two threads.
//
//   build/release/bin/pelagic_floating_bench [instruction set]
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "pelagic/floating/floating_bodies.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/hull_meshes.hpp"

namespace pelagic {
namespace {

constexpr int count = 1000, rounds = 60;
constexpr double step_s = 1.0 / 60;

template <class Work>
double ms_of(Work work) {
    const auto begin = std::chrono::steady_clock::now();
    work();
    return 1e3 * std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

void measure(Isa isa, int threads) {
    const auto executor = make_thread_executor(threads);
    Ocean ocean(SeaState{}, {.executor = executor, .isa = isa, .queries = true, .depth = true});
    const Hull hull(boat_mesh(6, 2, 1.2), {.mass_kg = 3500});
    FloatingBodies bodies(executor);
    for (int i = 0; i < count; ++i) bodies.add(hull, hull.at_rest(i % 32 * 25.0, i / 32 * 25.0, 0.1 * i));
    std::vector<double> ticks, frames;
    for (int i = 0; i < rounds; ++i) {
        const Frame* frame = nullptr;
        frames.push_back(ms_of([&] { frame = &ocean.frame_at((i + 0.5) * step_s); }));
        ticks.push_back(ms_of([&] { bodies.step(*frame, step_s); }));
    }
    for (auto* times : {&ticks, &frames}) std::sort(times->begin(), times->end());
    std::printf("%-8s %7d %9.2f (%.2f to %.2f) %9.3f\n", std::string(name_of(isa)).c_str(), threads,
                ticks[rounds / 2], ticks[rounds / 4], ticks[rounds * 3 / 4], frames[rounds / 2]);
}

}  // namespace
}  // namespace pelagic

int main(int count, char** arguments) {
    using namespace pelagic;
    const Isa isa = choose_isa(count > 1 ? isa_named(arguments[1]) : std::nullopt);
    std::printf("1,000 hulls of 128 triangles, default sea; ms, medians (quartiles)\n%-8s %7s %9s %17s %9s\n", "isa",
                "threads", "tick", "", "frame");
    for (const int threads : {1, 2}) measure(isa, threads);
}
