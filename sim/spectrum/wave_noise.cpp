#include "pelagic/sim/spectrum/wave_noise.hpp"

#include <cmath>

#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

// SplitMix64's step and finaliser (Steele, Lea, Flood 2014; constants of Stafford's mix 13).
constexpr std::uint64_t golden_gamma = 0x9E3779B97F4A7C15u;

std::uint64_t mix(std::uint64_t z) {
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9u;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBu;
    return z ^ (z >> 31);
}

constexpr double two_to_minus_53 = 1.0 / 9007199254740992.0;

std::uint64_t state_of(std::uint32_t seed, int tile, int m, int n) {
    const std::uint64_t wave = std::uint64_t{static_cast<std::uint32_t>(m)} << 32 | static_cast<std::uint32_t>(n);
    const std::uint64_t sea = std::uint64_t{static_cast<std::uint32_t>(tile)} << 32 | seed;
    // The seed is mixed before it meets the wave: otherwise seeds would be shifted copies of one another.
    return mix(wave + golden_gamma) ^ mix(sea + 2 * golden_gamma);
}

double squared_radius(std::uint64_t state) {
    const std::uint64_t first = mix(state + golden_gamma);
    const double u1 = static_cast<double>((first >> 11) + 1) * two_to_minus_53;  // never 0: its logarithm is taken
    return -2.0 * det::log(u1);
}

}  // namespace

GaussianPair gaussian_pair(std::uint32_t seed, int tile, int m, int n) {
    const std::uint64_t state = state_of(seed, tile, m, n);
    const std::uint64_t second = mix(state + 2 * golden_gamma);
    const double u2 = static_cast<double>(second >> 11) * two_to_minus_53;
    const double radius = std::sqrt(squared_radius(state));
    const det::SineCosine angle = det::sine_cosine_of_turns(u2);
    return {radius * angle.sine, radius * angle.cosine};
}

double gaussian_pair_square(std::uint32_t seed, int tile, int m, int n) {
    return squared_radius(state_of(seed, tile, m, n));
}

}  // namespace pelagic
