#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/always_inline.hpp"

namespace pelagic::kernels {

/// Splits a coordinate in texels into a cell of the cascade and the position in the cell. Uses only
/// sums and bit operations, which compilers vectorize. xsimd 8.1 does not convert between doubles
/// and floats.
template <class Arch>
PELAGIC_INLINE void split_coordinate(double texels, std::uint64_t last, std::int32_t& cell, float& within) {
    // So large that a double has no fraction, and that its lowest bits are a whole number.
    constexpr double whole = 0x1.8p52;
    const double shifted = texels + whole;
    // The difference from the nearest whole number; never -0.
    const double beyond = texels - (shifted - whole) + 0.0;
    const std::uint64_t is_below = std::bit_cast<std::uint64_t>(beyond) >> 63;
    const double one_if_below = std::bit_cast<double>((0 - is_below) & std::bit_cast<std::uint64_t>(1.0));
    cell = static_cast<std::int32_t>((std::bit_cast<std::uint64_t>(shifted) - is_below) & last);
    within = static_cast<float>(beyond + one_if_below);
}

template <class Arch>
void split_positions(const SplitPositionsJob& job) {
    const double* const __restrict x = job.x, * const __restrict z = job.z;
    std::int32_t* const __restrict cell_x = job.out.cell_x, * const __restrict cell_z = job.out.cell_z;
    float* const __restrict u = job.out.u, * const __restrict v = job.out.v;
    const double texel_m = job.texel_m, along = job.along, across = job.across;
    const auto last = static_cast<std::uint64_t>(job.resolution - 1);
    const std::size_t count = job.count;
    if (texel_m != 0) {
        for (std::size_t i = 0; i < count; ++i) {
            split_coordinate<Arch>(x[i] / texel_m, last, cell_x[i], u[i]);
            split_coordinate<Arch>(z[i] / texel_m, last, cell_z[i], v[i]);
        }
    } else {
        for (std::size_t i = 0; i < count; ++i) {
            split_coordinate<Arch>(along * x[i] + across * z[i], last, cell_x[i], u[i]);
            split_coordinate<Arch>(along * z[i] - across * x[i], last, cell_z[i], v[i]);
        }
    }
}

}  // namespace pelagic::kernels
