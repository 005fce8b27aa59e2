#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "sim/kernels/kernels.hpp"
#include "simd/always_inline.hpp"
#include "simd/neighbours.kernel.hpp"

namespace pelagic::kernels {

/// One row of cells. Inside a cell the surface is bilinear, so its Jacobian is linear and least at one of the corners,
/// where it is the cross product of the two edges that meet there.
template <class Arch>
void find_folds(const FindFoldsJob& job) {
    using V = xsimd::batch<float, Arch>;
    const SurfaceTexels& surface = job.surface;
    const std::size_t n = static_cast<std::size_t>(surface.resolution);
    const V texels_per_m(job.texels_per_m), most(job.most_jacobian);
    const auto place = [&](std::size_t x, std::size_t z) {
        const int i = static_cast<int>(x & (n - 1)), j = static_cast<int>(z & (n - 1));
        return (i >> surface.block_shift) * surface.block_stride + (i & (surface.block_columns - 1)) +
               j * surface.row_stride;
    };
    for (std::size_t z = job.first_row; z < job.first_row + job.rows; ++z) {
        std::uint8_t* bits = job.cells + z * (n / 8);
        for (std::size_t i = 0; i < n / 8; ++i) bits[i] = 0;
        for (std::size_t x = 0; x < n; x += V::size) {
            const int here = place(x, z), behind = place(x + V::size, z);
            const int below = place(x, z + 1), below_behind = place(x + V::size, z + 1);
            // Along x in both rows and along z in both columns, in texels.
            V x_low[2], x_high[2], z_low[2], z_high[2];
            const float* const planes[2] = {surface.dx, surface.dz};
            for (int axis = 0; axis < 2; ++axis) {
                const float* plane = planes[axis];
                const V v00 = V::load_unaligned(plane + here), v01 = V::load_unaligned(plane + below);
                const V v10 = one_behind<Arch>(v00, V::load_unaligned(plane + behind));
                const V v11 = one_behind<Arch>(v01, V::load_unaligned(plane + below_behind));
                const V one_along_x(axis == 0 ? 1.f : 0.f), one_along_z(axis == 1 ? 1.f : 0.f);
                x_low[axis] = one_along_x + (v10 - v00) * texels_per_m;
                x_high[axis] = one_along_x + (v11 - v01) * texels_per_m;
                z_low[axis] = one_along_z + (v01 - v00) * texels_per_m;
                z_high[axis] = one_along_z + (v11 - v10) * texels_per_m;
            }
            const auto jacobian = [](const V(&a)[2], const V(&b)[2]) { return a[0] * b[1] - a[1] * b[0]; };
            const V least = xsimd::min(xsimd::min(jacobian(x_low, z_low), jacobian(x_low, z_high)),
                                       xsimd::min(jacobian(x_high, z_low), jacobian(x_high, z_high)));
            if (!xsimd::any(least <= most)) continue;  // nearly always
            float lanes[V::size];
            least.store_unaligned(lanes);
            for (std::size_t lane = 0; lane < V::size; ++lane)
                if (lanes[lane] <= job.most_jacobian)
                    bits[(x + lane) / 8] = static_cast<std::uint8_t>(bits[(x + lane) / 8] | 1u << (x + lane) % 8);
        }
    }
}

}  // namespace pelagic::kernels
