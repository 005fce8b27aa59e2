#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/always_inline.hpp"

namespace pelagic::kernels {

/// Splits coordinates (a x + b z) into a cell of the cascade and the position in the cell. Uses
/// only sums and bit operations, which compilers vectorize. xsimd 8.1 does not convert between
/// doubles and floats.
template <class Arch>
PELAGIC_INLINE void split_axis(const SplitPositionsJob& job, double a, double b, std::int32_t* __restrict cell,
                               float* __restrict within) {
    const double* const x = job.x;
    const double* const z = job.z;
    // So large that a double has no fraction, and that its lowest bits are a whole number.
    constexpr double whole = 0x1.8p52;
    const auto last = static_cast<std::uint64_t>(job.resolution - 1);
    for (std::size_t i = 0; i < job.count; ++i) {
        const double texels = a * x[i] + b * z[i];
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
    split_axis<Arch>(job, job.along, job.across, job.out.cell_x, job.out.u);
    split_axis<Arch>(job, 0.0 - job.across, job.along, job.out.cell_z, job.out.v);
}

}  // namespace pelagic::kernels
