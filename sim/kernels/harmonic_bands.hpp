// Frequency bands, sixteen per octave: the first five binary digits of a wave's number of periods
// in one loop. Each of the first 32 harmonics therefore is a band of its own.
#pragma once

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

/// Returns the band of a harmonic. \pre harmonic > 0
inline std::size_t harmonic_band(std::uint32_t harmonic) {
    const auto bits = std::bit_cast<std::int32_t>(static_cast<float>(harmonic));
    return static_cast<std::size_t>((bits >> BlendArrivingWavesJob::band_shift) - BlendArrivingWavesJob::first_band);
}

/// Returns the mean of the first and last harmonic of a band. Some low bands contain no harmonic.
inline double middle_harmonic(std::size_t band) {
    const auto min = [](std::size_t of) {
        return std::ceil(std::ldexp(1 + static_cast<double>(of % 16) / 16, static_cast<int>(of / 16)));
    };
    return std::max(min(band), (min(band) + min(band + 1) - 1) / 2);
}

}  // namespace pelagic
