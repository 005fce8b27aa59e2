// The job of shore waves (sim/shore/shore_source.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

namespace pelagic {

/// Sums the waves at a time t, texel by texel. Each texel stores the complex amplitude C of each
/// wave, which contributes C e^(-i omega t) to the sum h + i q. The length of h + i q is the
/// envelope of the crests. Where the envelope exceeds `highest_envelope`, the waves are scaled down
/// to it. Then the crests are sharpened: h + s (h^2 - q^2) (Tayfun 1980). Where the envelope
/// approaches `breaking_envelope`, foam appears behind the crests. The velocity potential is the
/// sum of g / omega q. A level that is constant in time adds to heights and envelopes.
struct ShoreRowsJob {
    static constexpr std::size_t group_texels = 16;
    /// Foam starts at white_from times the breaking envelope and is complete at (white_from +
    /// white_over) times it.
    static constexpr float white_from = 0.85f, white_over = 0.3f;

    /// Factors of a wave at time t.
    struct Moment {
        float cosine, sine, omega;
        float potential;  ///< g / omega, m/s
    };
    const float* waves;  ///< group by group, wave by wave: 16 real parts, then 16 imaginary parts
    const Moment* moments;
    std::size_t wave_count;
    const std::uint8_t* has_waves;   ///< of each group; 0 if all amplitudes of the group are 0
    const float* highest_envelope;   ///< of each texel, metres, above 0
    const float* breaking_envelope;  ///< of each texel, metres, above 0
    const float* sharpness;          ///< s of each texel, 1/m
    const float* level;              ///< of each texel, metres
    std::size_t first_group, groups;
    float *height, *vertical_velocity, *potential, *reach;  ///< of each texel
    std::uint8_t* foam;
    float *lowest, *highest;  ///< extremes of the heights, including 0
};

}  // namespace pelagic
