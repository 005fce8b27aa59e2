#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "sim/kernels/kernels.hpp"
#include "sim/kernels/mipmaps.kernel.hpp"
#include "simd/exact.kernel.hpp"
#include "simd/half.kernel.hpp"
#include "simd/lanes.hpp"

namespace pelagic::kernels {

/// Three rows of one plane around the row at hand.
struct RowWindow {
    const float *above, *here, *below;
};

template <class Arch>
struct Surface {
    xsimd::batch<float, Arch> n_x, n_y, n_z;  ///< unit normal
    xsimd::batch<float, Arch> jacobian;
};

template <class Arch>
inline Surface<Arch> surface_at(const RowWindow (&rows)[3], std::size_t x, float half_texels_per_metre) {
    using V = xsimd::batch<float, Arch>;
    const V scale(half_texels_per_metre);
    const V one(1.f);
    const auto along_x = [&](const RowWindow& w) {
        return (V::load_unaligned(w.here + x + 1) - V::load_unaligned(w.here + x - 1)) * scale;
    };
    const auto along_z = [&](const RowWindow& w) {
        return (V::load_aligned(w.below + x) - V::load_aligned(w.above + x)) * scale;
    };
    const V dx_x = along_x(rows[0]), dx_z = along_z(rows[0]);
    const V h_x = along_x(rows[1]), h_z = along_z(rows[1]);
    const V dz_x = along_x(rows[2]), dz_z = along_z(rows[2]);

    const V j_xx = one + dx_x;
    const V j_zz = one + dz_z;
    const V jacobian = j_xx * j_zz - dx_z * dz_x;
    const V n_x = h_z * dz_x - h_x * j_zz;
    const V n_z = h_x * dx_z - h_z * j_xx;
    // A surface crushed to a point has no normal; the guard keeps it finite.
    const V squared = n_x * n_x + jacobian * jacobian + n_z * n_z;
    const V inverse = divided<Arch>(one, square_root<Arch>(xsimd::max(squared, V(1e-30f))));
    return {n_x * inverse, jacobian * inverse, n_z * inverse, jacobian};
}

/// Four half floats a texel: dx, height, dz, foam.
template <class Arch>
inline void store_halves(const RowWindow (&rows)[3], std::size_t x, xsimd::batch<float, Arch> jacobian,
                         std::uint16_t* out) {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;
    const V foam = clamped<Arch>((V(0.5f) - jacobian) * V(2.f), 0.f, 1.f);
    const I low = half_bits<Arch>(V::load_aligned(rows[0].here + x)) |
                  (half_bits<Arch>(V::load_aligned(rows[1].here + x)) << 16);
    const I high = half_bits<Arch>(V::load_aligned(rows[2].here + x)) | (half_bits<Arch>(foam) << 16);

    alignas(64) std::uint32_t pairs[2][V::size];
    xsimd::bitwise_cast<xsimd::batch<std::uint32_t, Arch>>(low).store_aligned(pairs[0]);
    xsimd::bitwise_cast<xsimd::batch<std::uint32_t, Arch>>(high).store_aligned(pairs[1]);
    for (std::size_t i = 0; i < V::size; ++i) {
        out[4 * i] = static_cast<std::uint16_t>(pairs[0][i]);
        out[4 * i + 1] = static_cast<std::uint16_t>(pairs[0][i] >> 16);
        out[4 * i + 2] = static_cast<std::uint16_t>(pairs[1][i]);
        out[4 * i + 3] = static_cast<std::uint16_t>(pairs[1][i] >> 16);
    }
}

template <class Arch>
void gradients(const GradientsJob& job) {
    using V = xsimd::batch<float, Arch>;
    const std::size_t size = job.resolution;
    const V length(job.normal_length);

    for (std::size_t x = 0; x < size; x += lane_block) {
        // Sums of the two rows, to be halved along x for the first mip.
        alignas(64) float sums[4][lane_block];
        for (std::size_t half = 0; half < 2; ++half) {
            const std::size_t z = 2 * job.row_pair + half;
            RowWindow rows[3];
            for (int c = 0; c < 3; ++c) {
                const auto row = [&](std::size_t j) {
                    return job.planes[c] + static_cast<std::ptrdiff_t>(j & (size - 1)) * job.stride;
                };
                rows[c] = {row(z + size - 1), row(z), row(z + 1)};
            }
            for (std::size_t lane = 0; lane < lane_block; lane += V::size) {
                const Surface<Arch> at = surface_at<Arch>(rows, x + lane, job.half_texels_per_metre);
                const V clamped_jacobian = clamped<Arch>(at.jacobian, -1.f, 1.f);
                pack_rgba8<Arch>(at.n_x, at.n_z, clamped_jacobian, V(job.smoothness),
                                 job.rgba8 + z * size + x + lane);
                store_halves<Arch>(rows, x + lane, at.jacobian, job.rgba16f + 4 * (z * size + x + lane));

                const V values[4] = {at.n_x * length, at.n_y * length, at.n_z * length, clamped_jacobian};
                for (std::size_t c = 0; c < 4; ++c) {
                    float* sum = sums[c] + lane;
                    (half == 0 ? values[c] : V::load_aligned(sum) + values[c]).store_aligned(sum);
                }
            }
        }
        for (std::size_t c = 0; c < 4; ++c)
            for (std::size_t i = 0; i < lane_block / 2; ++i)
                job.mip_row[c][x / 2 + i] = (sums[c][2 * i] + sums[c][2 * i + 1]) * 0.25f;
    }
}

}  // namespace pelagic::kernels
