// The random numbers of a sea: one pair of Gaussian variates per wave.
//
// A draw depends on (seed, cascade, m, n) only, where m and n are the wave's signed indices. It
// does not depend on the grid, the order of the calls or the thread. A finer grid therefore keeps
// the coarse grid's waves and adds shorter ones. The draw of -k is available wherever k is computed
// (VR Ocean, 3.2.5 and docs/errata.md).
#pragma once

#include <cstdint>

namespace pelagic {

/// Two independent standard normal variates.
struct GaussianPair {
    double re, im;
};

/// Returns the draw of the wave vector (2 pi / L)(m, n) in the sea `seed` and the cascade number
/// `cascade`. The key is hashed with SplitMix64 (Steele et al. 2014), then transformed with
/// Box-Muller (VR Ocean, equation 12) on two 53-bit uniforms, u1 in (0, 1]. Bit-identical on every
/// machine.
GaussianPair gaussian_pair(std::uint32_t seed, int cascade, int m, int n);

/// Returns re^2 + im^2 of gaussian_pair(), at half the cost, because the angle is not needed.
double gaussian_pair_square(std::uint32_t seed, int cascade, int m, int n);

}  // namespace pelagic
