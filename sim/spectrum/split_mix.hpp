// SplitMix64 (Steele, Lea, Flood 2014; constants of Stafford's mix 13): draws by key, the same bits on every machine.
#pragma once

#include <cstdint>

namespace pelagic {

/// What the generator's state grows by from one draw to the next.
inline constexpr std::uint64_t golden_gamma = 0x9E3779B97F4A7C15u;

/// The generator's finaliser: a draw of 64 bits from its state.
constexpr std::uint64_t split_mix(std::uint64_t state) {
    state = (state ^ (state >> 30)) * 0xBF58476D1CE4E5B9u;
    state = (state ^ (state >> 27)) * 0x94D049BB133111EBu;
    return state ^ (state >> 31);
}

}  // namespace pelagic
