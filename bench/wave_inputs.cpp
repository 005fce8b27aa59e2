// Benchmark of wave inputs on one thread: oceans with and without them take turns.
//
//   taskset -c 1 build/release/bin/pelagic_inputs_bench [instruction set]
//
// Inputs are sixteen Gerstner waves from 120 to 2 m with a ring of 6 m in the cascades that accept
// them, and an input that adds zeros to every cascade, which measures the stage itself. Prints
// medians of frames.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pelagic/sim/gerstner_input.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/sim/ripple_input.hpp"

namespace pelagic {
namespace {

constexpr int frames = 1000;

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

void measure(const char* name, const SeaState& sea, Isa isa) {
    const auto ocean_with = [&](std::vector<std::shared_ptr<WaveInput>> inputs) {
        return std::make_unique<Ocean>(
            sea, OceanOptions{.executor = make_serial_executor(), .isa = isa, .inputs = std::move(inputs)});
    };
    const auto waves =
        std::make_shared<GerstnerInput>(analytic_sea({.waves = 16, .longest_m = 120, .shortest_m = 2}));
    const auto zeros = std::make_shared<CallbackInput>([](const InputRows&) {});
    const std::unique_ptr<Ocean> oceans[] = {
        ocean_with({}), ocean_with({zeros}),
        ocean_with({waves, std::make_shared<RippleInput>(Ripple{.wavelength_m = 6, .amplitude_m = 0.3})})};
    std::vector<double> seconds[std::size(oceans)];
    for (int frame = -1; frame < frames; ++frame)
        for (std::size_t i = 0; i < std::size(oceans); ++i) {
            const double each = seconds_of(*oceans[i], frame / 72.0);
            if (frame >= 0) seconds[i].push_back(each);
        }
    const double none = median_us(seconds[0]);
    std::printf("%-10s %-7s %9.1f", name, std::string(name_of(isa)).c_str(), none);
    for (const std::size_t i : {1, 2})
        std::printf(" %9.1f (%.2f)", median_us(seconds[i]), median_us(seconds[i]) / none);
    std::printf("  %zu waves\n", waves->held().waves.size());
}

}  // namespace
}  // namespace pelagic

int main(int argc, char** argv) {
    using namespace pelagic;
    const std::optional<Isa> wanted = argc > 1 ? isa_named(argv[1]) : std::nullopt;
    const Isa isa = choose_isa(wanted);
    std::printf("microseconds a frame, in parts of one without inputs in brackets\n%-10s %-7s %9s %9s        %9s\n",
                "sea", "isa", "none", "zeros", "waves and ring");
    measure("4 x 128", {}, isa);
    measure("3 x 128", {.cascades = 3}, isa);
    measure("1 x 256", {.patch_size_m = 250}, isa);
    measure("4 x 256", {.resolution = 256}, isa);
}
