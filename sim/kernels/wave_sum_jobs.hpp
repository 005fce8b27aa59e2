// Jobs of the exact sum over waves (sim/exact_water.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

namespace pelagic {

/// A block of waves of a cascade at one moment, by wave number, the smallest first. Each entry is the
/// sum of the waves of k = (2 pi / L)(m, n) and of -k. With E = e^{ik.x} its height is
/// Re(H E) (1 + mirror), and F E gives its velocities (SumWaterJob). Arrays are aligned.
struct WaveBlock {
    /// Partial sums of floats, whose number is that of no instruction set. The waves i, i + 16, ...
    /// of a block are added in one of them, so that all instruction sets have the same rounding.
    static constexpr std::size_t partial_sums = 16;
    static constexpr std::size_t max_count = 512;

    const std::uint32_t *m, *n;  ///< signed, mod 2^32
    const float* steps;          ///< |k| L / 2 pi, at least 1
    const float* mirror;         ///< e^{-2kd}; null if all are 0
    const float *head_re, *head_im, *flow_re, *flow_im;
    std::size_t count;  ///< a multiple of partial_sums, at most max_count
};

/// Moves waves to a moment of the loop. With S' of packed_spectrum.hpp and the cosine c and the sine
/// s of the phase, the waves of k and -k have the sum S'_xy c + S'_zw s, and the difference
/// (S'_y s - S'_w c) + i (S'_z c - S'_x s).
struct MoveWavesJob {
    const std::uint32_t* harmonics;
    std::uint32_t fraction;    ///< of the loop, in units of 2^-32
    const float* packed[4];    ///< S'
    const float* flow_factor;  ///< of the difference
    std::size_t count;         ///< a multiple of WaveBlock::partial_sums
    float *head_re, *head_im, *flow_re, *flow_im;
};

/// Adds the heights of a block's waves to those of points.
struct SumHeightsJob {
    WaveBlock waves;
    const std::uint32_t *x, *z;  ///< positions along the cascade's axes, in units of 2^-32 L
    std::size_t points;
    double* heights;
};

/// Adds the motion of a block's waves to that of points. With a = e^{-ks} and b = mirror / a:
///
///   head    Re(H E) (a + b)       along, across  (m, n) Re(F E) (a + b),  up  |k| Im(F E) (a - b)
///   slopes  (m, n) Im(H E) (a + b),  |k| Re(H E) (a - b)
///
/// Points at which the block's smallest k s is over `max_decay` receive nothing.
struct SumWaterJob {
    enum Sum { head, along, across, up, slope_along, slope_across, slope_up, sums };
    static constexpr float max_decay = 20;  ///< e^-20 is 2e-9

    WaveBlock waves;
    const std::uint32_t *x, *z;  ///< as in SumHeightsJob
    const float* decay;          ///< 2 pi s / L, at least 0 and at most 1e30
    std::size_t points;
    double* all;  ///< point by point, each the sums
};

}  // namespace pelagic
