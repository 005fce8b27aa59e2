// SplitMix64 (Steele, Lea, Flood 2014; constants of Stafford's mix 13): random numbers by key,
// bit-identical on every machine.
#pragma once

#include <cstdint>

namespace pelagic {

/// Increment of the generator's state per draw.
inline constexpr std::uint64_t golden_gamma = 0x9E3779B97F4A7C15u;

/// Factor from 53 random bits to [0, 1).
inline constexpr double two_to_minus_53 = 1.0 / 9007199254740992.0;

/// Returns 64 random bits for a state (the generator's finaliser).
constexpr std::uint64_t split_mix(std::uint64_t state) {
    state = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9u;
    state = (state ^ (state >> 27)) * 0x94D049BB133111EBu;
    return state ^ (state >> 31);
}

}  // namespace pelagic
