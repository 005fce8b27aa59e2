#include "pelagic/sim/spectrum/wave_noise.hpp"

#include <cmath>

#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/split_mix.hpp"

namespace pelagic {
namespace {

std::uint64_t state_of(std::uint32_t seed, int cascade, int m, int n) {
    const std::uint64_t wave = std::uint64_t{static_cast<std::uint32_t>(m)} << 32 | static_cast<std::uint32_t>(n);
    const std::uint64_t sea = std::uint64_t{static_cast<std::uint32_t>(cascade)} << 32 | seed;
    // The seed is hashed before it is combined with the wave; otherwise seeds would give shifted
    // copies of one another.
    return split_mix(wave + golden_gamma) ^ split_mix(sea + 2 * golden_gamma);
}

double squared_radius(std::uint64_t state) {
    const std::uint64_t first = split_mix(state + golden_gamma);
    const double u1 = static_cast<double>((first >> 11) + 1) * two_to_minus_53;  // > 0, for the log
    return -2.0 * det::log(u1);
}

}  // namespace

GaussianPair gaussian_pair(std::uint32_t seed, int cascade, int m, int n) {
    const std::uint64_t state = state_of(seed, cascade, m, n);
    const std::uint64_t second = split_mix(state + 2 * golden_gamma);
    const double u2 = static_cast<double>(second >> 11) * two_to_minus_53;
    const double radius = std::sqrt(squared_radius(state));
    const det::SineCosine angle = det::sine_cosine_of_turns(u2);
    return {radius * angle.sine, radius * angle.cosine};
}

double gaussian_pair_square(std::uint32_t seed, int cascade, int m, int n) {
    return squared_radius(state_of(seed, cascade, m, n));
}

}  // namespace pelagic
