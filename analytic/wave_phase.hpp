// Phase of a wave at any time.
#pragma once

#include <cstdint>

#include "pelagic/simd/constants.hpp"

namespace pelagic {

/// Returns the fractional turns of frequency_hz * time_s, in units of 2^-64 of a turn. The product
/// of the two doubles is exact in integers, so the accuracy does not depend on the time, and
/// turned(f, -t) is -turned(f, t).
/// \pre both are finite
std::uint64_t turned(double frequency_hz, double time_s);

/// Returns the phase of a wave at x = z = 0, in turns in [-1/2, 1/2):
/// phase_turns - frequency_hz * time_s.
double turns_at_origin(double phase_turns, double frequency_hz, double time_s);

}  // namespace pelagic
