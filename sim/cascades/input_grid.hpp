// Cascade, frequency and phase of a wave that a wave input adds.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "pelagic/sim/spectrum/wave_list.hpp"
#include "pelagic/sim/wave_input.hpp"

namespace pelagic {

/// Returns the coarsest cascade that has more than three texels in the wave, and whose finer
/// neighbour has fewer than steps_of_few_waves grid steps between the wave and k = 0. A single
/// cascade needs more than two texels. Empty if no cascade qualifies.
std::optional<std::size_t> input_cascade_of(double turns_per_m, const InputMoment& moment);

/// Returns whether |m| and |n| are below N/2.
bool is_on_grid(const GridIndex& at, int resolution);

/// Returns the whole number of periods in a loop, from the deep-water dispersion relation.
std::uint32_t input_harmonic(double turns_per_m, double loop_period_s);

/// Returns a wave's phase at a moment, in turns in [-1/2, 1/2): its initial phase minus
/// harmonic * loop_turns / 2^32. The result is exact.
double input_turns(double phase_turns, std::uint32_t harmonic, std::uint32_t loop_turns);

}  // namespace pelagic
