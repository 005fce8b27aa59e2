// Where a wave is in its turn at any time.
#pragma once

#include <cstdint>

namespace pelagic {

inline constexpr double gravity_of_waves_mps2 = 9.80665;

/// frequency_hz x time_s without its whole turns, in parts of 2^-64 of a turn: the product of the two doubles is
/// taken exactly, as integers, so time loses no accuracy however long it runs, and -t is the same turned back.
/// \pre both are finite
std::uint64_t turned(double frequency_hz, double time_s);

/// Turns in [-1/2, 1/2) of a wave at x = z = 0: `phase_turns` less what it has turned.
double turns_at_origin(double phase_turns, double frequency_hz, double time_s);

}  // namespace pelagic
