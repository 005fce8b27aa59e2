// Benchmark of foam accumulation and decay on one thread: oceans with and without it take turns, at
// 72 frames per second.
//
//   taskset -c 1 build/release/bin/pelagic_foam_bench [instruction set]
//
// A frame after a tick of foam (0.19 s) also computes that tick; other frames only apply the decay.
// A jump in time computes 16 ticks. Prints medians of times, and means over all frames, which
// include the ticks.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <numeric>
#include <vector>

#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/sim/ocean.hpp"

namespace pelagic {
namespace {

constexpr double frames_per_second = 72;
constexpr int frames = 72 * 30;

double seconds_of(Ocean& ocean, double time_s) {
    const auto begin = std::chrono::steady_clock::now();
    ocean.frame_at(time_s);
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

double median_us(std::vector<double> seconds) {
    std::nth_element(seconds.begin(), seconds.begin() + static_cast<std::ptrdiff_t>(seconds.size() / 2),
                     seconds.end());
    return 1e6 * seconds[seconds.size() / 2];
}

double mean_us(const std::vector<double>& seconds) {
    return 1e6 * std::accumulate(seconds.begin(), seconds.end(), 0.0) / static_cast<double>(seconds.size());
}

void measure(const char* name, const SeaState& sea, Isa isa) {
    const auto ocean_with = [&](bool foam) {
        return std::make_unique<Ocean>(sea,
                                       OceanOptions{.executor = make_serial_executor(), .isa = isa, .foam = foam});
    };
    const auto without = ocean_with(false), with = ocean_with(true);
    const TickClock clock(sea.loop_period_s);
    std::vector<double> plain, with_tick, between_ticks, all, jumps;
    with->frame_at(-1 / frames_per_second);
    for (int frame = 0; frame < frames; ++frame) {
        const double time = frame / frames_per_second;
        const bool is_tick = clock.at(time).number != clock.at((frame - 1) / frames_per_second).number;
        plain.push_back(seconds_of(*without, time));
        all.push_back(seconds_of(*with, time));
        (is_tick ? with_tick : between_ticks).push_back(all.back());
    }
    for (int jump = 0; jump < 20; ++jump) jumps.push_back(seconds_of(*with, 7.0 * jump + 40));
    const double frame = median_us(plain);
    std::printf("%-10s %-7s %9.1f %9.1f (%.2f) %9.1f (%.2f) %9.1f (%.2f) %9.0f (%.1f)\n", name,
                std::string(name_of(isa)).c_str(), frame, median_us(between_ticks), median_us(between_ticks) / frame,
                median_us(with_tick), median_us(with_tick) / frame, mean_us(all), mean_us(all) / mean_us(plain),
                median_us(jumps), median_us(jumps) / frame);
}

}  // namespace
}  // namespace pelagic

int main(int argc, char** argv) {
    using namespace pelagic;
    const std::optional<Isa> wanted = argc > 1 ? isa_named(argv[1]) : std::nullopt;
    const Isa isa = choose_isa(wanted);
    std::printf(
        "microseconds a frame, in parts of one without foam in brackets\n%-10s %-7s %9s %9s        %9s        %9s    "
        "    %9s\n",
        "sea", "isa", "no foam", "no tick", "tick", "mean", "jump");
    measure("4 x 128", {}, isa);
    measure("3 x 128", {.cascades = 3}, isa);
    measure("1 x 256", {.patch_size_m = 250}, isa);
    measure("4 x 256", {.resolution = 256}, isa);
}
