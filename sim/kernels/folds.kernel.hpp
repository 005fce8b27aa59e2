#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/cell_strip.kernel.hpp"
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

    PELAGIC_INLINE TexelPairs(const SurfaceTexels& surface, std::ptrdiff_t upper_place, std::ptrdiff_t lower_place,
                              V texel) {
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

/// Sets the bits of the overturned cells among W columns of a row. Not inlined: it is rarely called.
template <class Arch>
void mark_overturned(const FindFoldsJob& job, std::size_t x, std::size_t z) {
    using V = xsimd::batch<float, Arch>;
    const SurfaceTexels& surface = job.surface;
    const std::size_t n = static_cast<std::size_t>(surface.resolution);
    const V texel(job.texel_m);
    const std::ptrdiff_t upper_row = static_cast<std::ptrdiff_t>(z) * surface.row_stride;
    const std::ptrdiff_t lower_row = static_cast<std::ptrdiff_t>((z + 1) & (n - 1)) * surface.row_stride;
    const auto pairs_at = [&](std::size_t column) {
        const std::ptrdiff_t offset = column_offset(surface, column);
        return TexelPairs<Arch>(surface, offset + upper_row, offset + lower_row, texel);
    };
    const V min = min_area<Arch>(pairs_at(x), pairs_at(x + V::size), texel);
    if (!xsimd::any(min <= V(job.max_area))) return;
    float lanes[V::size];
    min.store_unaligned(lanes);
    std::uint8_t* const bits = job.cells + z * (n / 8);
    for (std::size_t lane = 0; lane < V::size; ++lane)
        if (lanes[lane] <= job.max_area)
            bits[(x + lane) / 8] = static_cast<std::uint8_t>(bits[(x + lane) / 8] | 1u << (x + lane) % 8);
}

/// Computes the Jacobians only where the bound of cell_strip.kernel.hpp allows an overturned cell.
template <class Arch>
void find_folds(const FindFoldsJob& job) {
    using V = xsimd::batch<float, Arch>;
    using Strip = CellStrip<Arch, false, false>;
    // The bound's rounding error in units of a texel's area. Larger errors occur only far below 0.
    constexpr float rounding = 1e-3f;
    const SurfaceTexels surface = job.surface;
    const std::size_t n = static_cast<std::size_t>(surface.resolution);
    const V texel(job.texel_m), area(job.texel_m * job.texel_m);
    const V max(2 * (job.max_area + rounding * job.texel_m * job.texel_m));
    const std::size_t first_row = job.first_row, end_row = first_row + job.rows;
    std::uint8_t* const bits = job.cells;
    for (std::size_t i = first_row * (n / 8); i < end_row * (n / 8); ++i) bits[i] = 0;
    for (std::size_t z = first_row; z < end_row; z += max_strips * strip_rows) {
        const std::size_t remaining = (end_row - z) / strip_rows;
        const auto take = [&](std::size_t strip, std::size_t x, const Strip& cells,
                              const SideEdges<Arch>& behind) PELAGIC_INLINE_LAMBDA {
            const V stretched = xsimd::max(texel + cells.trace(behind), V(0.f));
            const V twice_min = (stretched * stretched + area) - cells.norm_squared(behind);
            if (!xsimd::any(twice_min <= max)) return;
            for (std::size_t row = 0; row < strip_rows; ++row)
                mark_overturned<Arch>(job, x, z + strip * strip_rows + row);
        };
        for_each_strip<Strip>(surface, z, remaining < max_strips ? remaining : max_strips, texel, texel, take);
    }
}

}  // namespace pelagic::kernels
