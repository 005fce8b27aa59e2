// The job of waves over a shore (sim/shore/shore_source.hpp).
#pragma once

#include <cstddef>
#include <cstdint>

namespace pelagic {

/// Waves of a moment, texel by texel. Of each wave a texel has the complex amplitude C, of which a time leaves C e^(-i omega t); with
/// h + i q their sum, its length is the envelope of the crests. Where the envelope is higher than waves stand they are cut down to
/// that; then crests are sharpened, h + s (h^2 - q^2) (Tayfun 1980). Where the envelope comes near the one at which waves break they turn
/// white behind their crests. The velocity potential is the sum of g / omega q.
struct ShoreRowsJob {
    static constexpr std::size_t group_texels = 16;
    /// Water turns white from here on, in parts of the breaking envelope, entirely so a further part above.
    static constexpr float white_from = 0.85f, white_over = 0.3f;

    /// Of a wave at the moment.
    struct Moment {
        float cosine, sine, omega;
        float potential;  ///< g / omega, m/s
    };
    const float* waves;  ///< group by group, wave by wave: 16 real parts, 16 imaginary ones
    const Moment* moments;
    std::size_t wave_count;
    const std::uint8_t* has_waves;   ///< of each group, or all its amplitudes are 0
    const float* highest_envelope;   ///< of each texel, above 0
    const float* breaking_envelope;  ///< of each texel, above 0
    const float* sharpness;          ///< s, 1/m
    std::size_t first_group, groups;
    float *height, *vertical_velocity, *potential, *reach;  ///< of each texel
    std::uint8_t* foam;
    float *lowest, *highest;  ///< of the heights, with 0
};

}  // namespace pelagic
