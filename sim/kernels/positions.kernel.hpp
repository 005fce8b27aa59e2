#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/always_inline.hpp"

namespace pelagic::kernels {

/// Splits coordinates, texels(i), into a cell of the cascade and the position in the cell. Uses
/// only sums and bit operations, which compilers vectorize. xsimd 8.1 does not convert between
/// doubles and floats.
template <class Arch, class Texels>
PELAGIC_INLINE void split_axis(const SplitPositionsJob& job, const Texels& texels_at, std::int32_t* __restrict cell,
                               float* __restrict within) {
    // So large that a double has no fraction, and that its lowest bits are a whole number.
    constexpr double whole = 0x1.8p52;
    const auto last = static_cast<std::uint64_t>(job.resolution - 1);
    for (std::size_t i = 0; i < job.count; ++i) {
        const double texels = texels_at(i);
        const double shifted = texels + whole;
        // The difference from the nearest whole number; never -0.
        const double beyond = texels - (shifted - whole) + 0.0;
        const std::uint64_t is_below = std::bit_cast<std::uint64_t>(beyond) >> 63;
        const double one_if_below = std::bit_cast<double>((0 - is_below) & std::bit_cast<std::uint64_t>(1.0));
        cell[i] = static_cast<std::int32_t>((std::bit_cast<std::uint64_t>(shifted) - is_below) & last);
        within[i] = static_cast<float>(beyond + one_if_below);
    }
}

template <class Arch>
void split_positions(const SplitPositionsJob& job) {
    const double *const x = job.x, *const z = job.z;
    const double texel_m = job.texel_m, along = job.along, across = job.across;
    const auto split = [&](const auto& texels_x, const auto& texels_z) PELAGIC_INLINE_LAMBDA {
        split_axis<Arch>(job, texels_x, job.out.cell_x, job.out.u);
        split_axis<Arch>(job, texels_z, job.out.cell_z, job.out.v);
    };
    if (texel_m != 0)
        split([=](std::size_t i) PELAGIC_INLINE_LAMBDA { return x[i] / texel_m; },
              [=](std::size_t i) PELAGIC_INLINE_LAMBDA { return z[i] / texel_m; });
    else
        split([=](std::size_t i) PELAGIC_INLINE_LAMBDA { return along * x[i] + across * z[i]; },
              [=](std::size_t i) PELAGIC_INLINE_LAMBDA { return along * z[i] - across * x[i]; });
}

}  // namespace pelagic::kernels
