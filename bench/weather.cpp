// Benchmark of frames during a sea-state transition, compared with frames of a steady sea, to find
// late frames.
//
//   build/release/bin/pelagic_weather_bench [ROUNDS [THREADS]]
//
// Frames run at 72 per second, a headset's rate, without other work: 8 s of a steady storm, then 8
// s in which a new ocean changes from calm to storm within 4 s, and computes its spectrum during
// the first frames. Rounds alternate, because other load on the machine varies. A frame's time is
// from schedule() to the end of complete().
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

#include "pelagic/sim/ocean.hpp"

namespace pelagic {
namespace {

using Clock = std::chrono::steady_clock;

constexpr double frame_s = 1.0 / 72, change_from_s = 3, change_over_s = 4, round_s = 8;

void time_round(const Forecast& forecast, int threads, std::vector<double>& into) {
    Ocean ocean(forecast, {.executor = make_default_executor(threads)});
    // Warms both slots and wakes threads.
    for (int warm = 0; warm < 20; ++warm) ocean.frame_at(-1000);
    const Clock::time_point start = Clock::now();
    for (int frame = 0; frame * frame_s < round_s; ++frame) {
        std::this_thread::sleep_until(
            start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(frame * frame_s)));
        const Clock::time_point before = Clock::now();
        ocean.frame_at(frame * frame_s);
        into.push_back(std::chrono::duration<double, std::milli>(Clock::now() - before).count());
    }
}

double quantile(std::vector<double>& ms, double part) {
    const auto at = ms.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(ms.size() - 1));
    std::nth_element(ms.begin(), at, ms.end());
    return *at;
}

int run(int rounds, int threads) {
    const SeaState calm = sea_preset_named("calm")->sea, storm = sea_preset_named("storm")->sea;
    const Forecast steady{.first = storm};
    const Forecast changing{.first = calm,
                            .changes = {{.sea = storm, .from_s = change_from_s, .over_s = change_over_s}}};
    std::vector<double> steady_ms, changing_ms;
    for (int round = 0; round < rounds; ++round) {
        time_round(steady, threads, steady_ms);
        time_round(changing, threads, changing_ms);
    }
    std::printf("%zu frames each, ms        median      p99\n", steady_ms.size());
    const auto print = [](const char* name, std::vector<double>& ms) {
        std::printf("  %-24s %8.3f %8.3f\n", name, quantile(ms, 0.5), quantile(ms, 0.99));
    };
    print("a steady storm", steady_ms);
    print("calm turns into storm", changing_ms);
    std::printf("  %-24s %8.2f %8.2f\n", "ratio", quantile(changing_ms, 0.5) / quantile(steady_ms, 0.5),
                quantile(changing_ms, 0.99) / quantile(steady_ms, 0.99));
    return 0;
}

}  // namespace
}  // namespace pelagic

int main(int argc, char** argv) {
    const int rounds = argc > 1 ? std::atoi(argv[1]) : 6, threads = argc > 2 ? std::atoi(argv[2]) : 0;
    return pelagic::run(std::max(rounds, 1), threads);
}
