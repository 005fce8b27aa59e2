#pragma once

#include <cstddef>
#include <cstdint>
#include <cstring>
#include <xsimd/xsimd.hpp>

#include "sim/kernels/kernels.hpp"
#include "simd/exact.kernel.hpp"
#include "simd/lanes.hpp"

namespace pelagic::kernels {

template <class Arch>
inline xsimd::batch<float, Arch> clamped(xsimd::batch<float, Arch> v, float least, float most) {
    using V = xsimd::batch<float, Arch>;
    return xsimd::min(xsimd::max(v, V(least)), V(most));
}

/// floor(v 255 + 1/2) for v in [0, 1].
template <class Arch>
inline xsimd::batch<std::int32_t, Arch> byte_of(xsimd::batch<float, Arch> v) {
    using V = xsimd::batch<float, Arch>;
    return xsimd::to_int(v * V(255.f) + V(0.5f));
}

/// VR Ocean, equations 50 and 51. `jacobian` is within [-1, 1], the rest as a unit vector and a smoothness are.
template <class Arch>
inline void pack_rgba8(xsimd::batch<float, Arch> n_x, xsimd::batch<float, Arch> n_z,
                       xsimd::batch<float, Arch> jacobian, xsimd::batch<float, Arch> smoothness, std::uint32_t* out) {
    using V = xsimd::batch<float, Arch>;
    const V half(0.5f);
    const auto packed = byte_of<Arch>(n_x * half + half) | (byte_of<Arch>(n_z * half + half) << 8) |
                        (byte_of<Arch>(jacobian * half + half) << 16) | (byte_of<Arch>(smoothness) << 24);
    xsimd::bitwise_cast<xsimd::batch<std::uint32_t, Arch>>(packed).store_unaligned(out);
}

template <class Arch>
void halve(const HalveJob& job) {
    for (std::size_t c = 0; c < 4; ++c) {
        const float* above = job.above[c];
        const float* below = job.below[c];
        float* out = job.out[c];
        for (std::size_t x = 0; x < job.count; ++x)
            out[x] = ((above[2 * x] + below[2 * x]) + (above[2 * x + 1] + below[2 * x + 1])) * 0.25f;
    }
}

template <class Arch>
void pack_mip(const PackMipJob& job) {
    using V = xsimd::batch<float, Arch>;
    const V one(1.f);
    for (std::size_t x = 0; x < job.count; x += V::size) {
        const V n_x = V::load_aligned(job.row[0] + x);
        const V n_y = V::load_aligned(job.row[1] + x);
        const V n_z = V::load_aligned(job.row[2] + x);
        const V length = square_root<Arch>(n_x * n_x + n_y * n_y + n_z * n_z);

        // Equation 53.
        const V t = clamped<Arch>((length - V(2.f / 3.f)) * V(3.f), 0.f, 1.f);
        const V roughness = xsimd::max(one - t * (V(0.85f) + t * V(0.15f)), V(0.f));
        const V smoothness = one - square_root<Arch>(roughness);

        const V inverse = divided<Arch>(one, xsimd::max(length, V(1e-15f)));
        alignas(64) std::uint32_t texels[V::size];
        pack_rgba8<Arch>(n_x * inverse, n_z * inverse, V::load_aligned(job.row[3] + x), smoothness, texels);
        const std::size_t here = job.count - x < V::size ? job.count - x : V::size;
        std::memcpy(job.out + x, texels, here * sizeof(std::uint32_t));
    }
}

}  // namespace pelagic::kernels
