#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/neighbours.kernel.hpp"

namespace pelagic::kernels {

/// The horizontal displacement, along x and along z, of W texels of two consecutive rows.
template <class Arch>
struct TexelPairs {
    using V = xsimd::batch<float, Arch>;
    V upper[2], lower[2];
    V along_z[2];  ///< displaced position of the lower texel relative to the upper one, metres

    PELAGIC_INLINE TexelPairs(const SurfaceTexels& surface, int upper_place, int lower_place, V texel) {
        const float* const planes[2] = {surface.dx, surface.dz};
        for (int axis = 0; axis < 2; ++axis) {
            upper[axis] = V::load_unaligned(planes[axis] + upper_place);
            lower[axis] = V::load_unaligned(planes[axis] + lower_place);
            along_z[axis] = lower[axis] - upper[axis];
        }
        along_z[1] = along_z[1] + texel;
    }
};

/// Returns the minimum Jacobian in each of W cells, times the texel's area. Inside a cell the
/// surface is bilinear, so its Jacobian is linear. The minimum is at a corner, where the Jacobian
/// is the cross product of the two adjacent edges.
template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> min_area(const TexelPairs<Arch>& here, const TexelPairs<Arch>& behind,
                                                  xsimd::batch<float, Arch> texel) {
    using V = xsimd::batch<float, Arch>;
    V upper_x[2], lower_x[2], behind_z[2];
    for (int axis = 0; axis < 2; ++axis) {
        upper_x[axis] = lanes_behind<1, Arch>(here.upper[axis], behind.upper[axis]) - here.upper[axis];
        lower_x[axis] = lanes_behind<1, Arch>(here.lower[axis], behind.lower[axis]) - here.lower[axis];
        behind_z[axis] = lanes_behind<1, Arch>(here.along_z[axis], behind.along_z[axis]);
    }
    upper_x[0] = upper_x[0] + texel;
    lower_x[0] = lower_x[0] + texel;
    const auto cross = [](const V(&a)[2], const V(&b)[2]) { return a[0] * b[1] - a[1] * b[0]; };
    return xsimd::min(xsimd::min(cross(upper_x, here.along_z), cross(upper_x, behind_z)),
                      xsimd::min(cross(lower_x, here.along_z), cross(lower_x, behind_z)));
}

template <class Arch>
void find_folds(const FindFoldsJob& job) {
    using V = xsimd::batch<float, Arch>;
    const SurfaceTexels& surface = job.surface;
    const std::size_t n = static_cast<std::size_t>(surface.resolution);
    const V texel(job.texel_m), max(job.max_area);
    for (std::size_t z = job.first_row; z < job.first_row + job.rows; ++z) {
        std::uint8_t* bits = job.cells + z * (n / 8);
        for (std::size_t i = 0; i < n / 8; ++i) bits[i] = 0;
        const int upper_row = static_cast<int>(z) * surface.row_stride;
        const int lower_row = static_cast<int>((z + 1) & (n - 1)) * surface.row_stride;
        const auto pairs_at = [&](std::size_t x) {
            const int i = static_cast<int>(x & (n - 1));
            const int column = (i >> surface.block_shift) * surface.block_stride + (i & (surface.block_columns - 1));
            return TexelPairs<Arch>(surface, column + upper_row, column + lower_row, texel);
        };
        TexelPairs<Arch> here = pairs_at(0);
        for (std::size_t x = 0; x < n; x += V::size) {
            const TexelPairs<Arch> behind = pairs_at(x + V::size);
            const V min = min_area<Arch>(here, behind, texel);
            here = behind;
            if (!xsimd::any(min <= max)) continue;  // true for almost all cells
            float lanes[V::size];
            min.store_unaligned(lanes);
            for (std::size_t lane = 0; lane < V::size; ++lane)
                if (lanes[lane] <= job.max_area)
                    bits[(x + lane) / 8] = static_cast<std::uint8_t>(bits[(x + lane) / 8] | 1u << (x + lane) % 8);
        }
    }
}

}  // namespace pelagic::kernels
