// Which cascade takes a wave that an application adds, and how it runs there.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "pelagic/sim/spectrum/wave_list.hpp"
#include "pelagic/sim/wave_input.hpp"

namespace pelagic {

/// The finest cascade with steps_of_few_waves of its grid between the wave and k = 0, or the first that has three texels of it. None
/// if none has (two, where there is one cascade).
std::optional<std::size_t> input_cascade_of(double turns_per_m, const InputMoment& moment);

/// Neither N/2 nor beyond, along either axis.
bool is_on_grid(const GridIndex& at, int resolution);

/// Periods in a loop, in deep water.
std::uint32_t input_harmonic(double turns_per_m, double loop_period_s);

/// Where a wave is at a moment: its phase less what it has turned, exact, in [-1/2, 1/2).
double input_turns(double phase_turns, std::uint32_t harmonic, std::uint32_t loop_turns);

}  // namespace pelagic
