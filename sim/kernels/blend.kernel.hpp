#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/exact.kernel.hpp"
#include "pelagic/simd/gather.kernel.hpp"
#include "pelagic/simd/same_bits.kernel.hpp"

namespace pelagic::kernels {

/// h0(k) = a + ib and conj(h0(-k)) = c + id of W waves, in units of half a metre times `scale`.
template <class Arch>
struct UnpackedWaves {
    using V = xsimd::batch<float, Arch>;
    V a, b, c, d;
};

template <class Arch>
PELAGIC_INLINE UnpackedWaves<Arch> unpacked(const float* packed, const xsimd::batch<float, Arch>& scale) {
    using V = xsimd::batch<float, Arch>;
    const auto row = [&](std::size_t i) { return V::load_aligned(packed + i * V::size) * scale; };
    const V s0 = row(0), s1 = row(1), s2 = row(2), s3 = row(3);
    return {s0 - s3, s1 + s2, s0 + s3, s1 - s2};
}

/// Returns the amplitude of the blended energy. Both amplitudes have the same sign if they share a
/// random draw. If the signs differ (listed waves or rounding errors), the amplitude is blended
/// linearly through 0.
template <class Arch>
PELAGIC_INLINE xsimd::batch<float, Arch> between(const xsimd::batch<float, Arch>& before,
                                                 const xsimd::batch<float, Arch>& after,
                                                 const xsimd::batch<float, Arch>& weight_before,
                                                 const xsimd::batch<float, Arch>& weight) {
    using V = xsimd::batch<float, Arch>;
    const V energy = weight_before * (before * before) + weight * (after * after);
    const V through_zero = weight_before * before + weight * after;
    return xsimd::select(before * after < V(0.f), through_zero,
                         xsimd::copysign(square_root<Arch>(energy), before + after));
}

template <class Arch>
PELAGIC_INLINE void blend_wave(const float* before, const float* after, const xsimd::batch<float, Arch>& weight,
                               float* out) {
    using V = xsimd::batch<float, Arch>;
    const V scale(BlendWavesJob::scale), unscale(0.5f / BlendWavesJob::scale), weight_before = V(1.f) - weight;
    const UnpackedWaves<Arch> from = unpacked<Arch>(before, scale), to = unpacked<Arch>(after, scale);
    const V a = between<Arch>(from.a, to.a, weight_before, weight),
            b = between<Arch>(from.b, to.b, weight_before, weight);
    const V c = between<Arch>(from.c, to.c, weight_before, weight),
            d = between<Arch>(from.d, to.d, weight_before, weight);
    const auto put = [&](std::size_t i, const V& value) { (value * unscale).store_aligned(out + i * V::size); };
    put(0, a + c);
    put(1, b + d);
    put(2, b - d);
    put(3, c - a);
}

/// Blends the leans of W pairs of waves, and scales their directions by the new cosine over that of
/// `before`.
template <class Arch>
PELAGIC_INLINE void blend_leans(const float* before, const float* after, const xsimd::batch<float, Arch>& weight,
                                float* out) {
    using V = xsimd::batch<float, Arch>;
    const V one(1.f), from = V::load_aligned(before + lean_tangent * V::size);
    const V to = (one - weight) * from + weight * V::load_aligned(after + lean_tangent * V::size);
    const V cosines = square_root<Arch>(divided<Arch>(one + from * from, one + to * to));
    to.store_aligned(out + lean_tangent * V::size);
    for (const std::size_t direction : {direction_x, direction_z})
        (V::load_aligned(before + direction * V::size) * cosines).store_aligned(out + direction * V::size);
}

/// Blends one block of both spectra. \param weight_of  returns s of a wave pair, given its index in
/// the block
template <class Arch, class Job, class WeightOf>
PELAGIC_INLINE void blend_block(const Job& job, WeightOf weight_of) {
    using V = xsimd::batch<float, Arch>;
    constexpr std::size_t pair_floats = wave_quantities * V::size;
    const float* before = job.before;
    const float* after = job.after;
    float* out = job.out;
    for (std::size_t i = 0; i < job.pairs; ++i, before += pair_floats, after += pair_floats, out += pair_floats) {
        const V weight = weight_of(i);
        blend_wave<Arch>(before + plus_cos_re * V::size, after + plus_cos_re * V::size, weight,
                         out + plus_cos_re * V::size);
        blend_wave<Arch>(before + minus_cos_re * V::size, after + minus_cos_re * V::size, weight,
                         out + minus_cos_re * V::size);
        blend_leans<Arch>(before, after, weight, out);
    }
}

template <class Arch>
void blend_waves(const BlendWavesJob& job) {
    using V = xsimd::batch<float, Arch>;
    const V weight(job.weight);
    blend_block<Arch>(job, [&](std::size_t) { return weight; });
}

template <class Arch>
void blend_arriving_waves(const BlendArrivingWavesJob& job) {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    const I first(BlendArrivingWavesJob::first_band), none(0), last(job.last_band);
    blend_block<Arch>(job, [&](std::size_t pair) {
        const V harmonic = xsimd::to_float(same_bits<I>(U::load_aligned(job.harmonics + pair * V::size)));
        const I band = (same_bits<I>(harmonic) >> BlendArrivingWavesJob::band_shift) - first;
        // Harmonic 0 is no wave; any band is valid for it.
        return Gather<Arch>(xsimd::min(xsimd::max(band, none), last)).from(job.weights);
    });
}

}  // namespace pelagic::kernels
