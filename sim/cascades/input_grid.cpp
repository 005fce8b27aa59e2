#include "pelagic/sim/cascades/input_grid.hpp"

#include <algorithm>
#include <cstdlib>

#include "pelagic/analytic/wave_phase.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/simd/constants.hpp"

namespace pelagic {
namespace {

/// Texels in a wave at the end of a cascade's band, in a stack and in a single cascade.
constexpr double texels_of_stack = 3, texels_of_one_cascade = 2;

}  // namespace

std::optional<std::size_t> input_cascade_of(double turns_per_m, const InputMoment& moment) {
    const auto& grids = moment.grids;
    const double texels = grids.size() == 1 ? texels_of_one_cascade : texels_of_stack;
    for (std::size_t cascade = 0; cascade < grids.size(); ++cascade) {
        const double shortest = moment.resolution / (texels * grids[cascade].side_m);
        const bool is_last = cascade + 1 == grids.size();
        const double end = is_last ? shortest : std::min(shortest, steps_of_few_waves / grids[cascade + 1].side_m);
        if (turns_per_m < end) return cascade;
    }
    return {};
}

bool is_on_grid(const GridIndex& at, int resolution) {
    return std::max(std::abs(at.m), std::abs(at.n)) < resolution / 2;
}

std::uint32_t input_harmonic(double turns_per_m, double loop_period_s) {
    return loop_harmonic(angular_frequency(two_pi * turns_per_m, deep_water), loop_period_s);
}

double input_turns(double phase_turns, std::uint32_t harmonic, std::uint32_t loop_turns) {
    const std::uint64_t elapsed = std::uint64_t{harmonic * loop_turns} << 32;
    return static_cast<double>(static_cast<std::int64_t>(turned(1, phase_turns) - elapsed)) * 0x1p-64;
}

}  // namespace pelagic
