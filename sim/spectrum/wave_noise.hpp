// The random numbers behind a sea: one pair of Gaussians for each wave.
//
// A draw is keyed by (seed, cascade, m, n), the wave's own signed numbers, and by nothing else: not by the grid, the order
// of the calls or the thread. A finer grid therefore keeps the coarse grid's waves and only adds shorter ones, and
// the draw of -k is known wherever k is computed (VR Ocean, 3.2.5 and the errata in docs/equations.md).
#pragma once

#include <cstdint>

namespace pelagic {

/// Two independent standard normal variates.
struct GaussianPair {
    double re, im;
};

/// The draw of the wave vector (2 pi / L)(m, n) in the sea `seed` and the cascade number `cascade`: SplitMix64 (Steele et al. 2014) of the key, then
/// Box-Muller (VR Ocean, equation 12) on two 53-bit uniforms, u1 in (0, 1]. Same bits on every machine.
GaussianPair gaussian_pair(std::uint32_t seed, int cascade, int m, int n);

/// re^2 + im^2 of that draw, for half the work: the angle drops out.
double gaussian_pair_square(std::uint32_t seed, int cascade, int m, int n);

}  // namespace pelagic
