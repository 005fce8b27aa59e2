#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/shore_jobs.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/exact.kernel.hpp"

namespace pelagic::kernels {

/// W texels of a group: h, q, their time derivatives and the velocity potential.
template <class Arch>
struct ShoreSum {
    using V = xsimd::batch<float, Arch>;
    V h = V(0.f), q = V(0.f), h_t = V(0.f), q_t = V(0.f), potential = V(0.f);

    /// Adds e^(-i omega t) C and its time derivative, which is -i omega times it.
    PELAGIC_INLINE void add(const float* re, const float* im, const ShoreRowsJob::Moment& moment) {
        const V a = V::load_aligned(re), b = V::load_aligned(im);
        const V cosine(moment.cosine), sine(moment.sine), omega(moment.omega);
        const V real = a * cosine + b * sine, imaginary = b * cosine - a * sine;
        h = h + real;
        q = q + imaginary;
        h_t = h_t + omega * imaginary;
        q_t = q_t - omega * real;
        potential = potential + V(moment.potential) * imaginary;
    }
};

template <class Arch>
void shore_rows(const ShoreRowsJob& job) {
    using V = xsimd::batch<float, Arch>;
    constexpr std::size_t group = ShoreRowsJob::group_texels, lanes = V::size;
    const V none(0.f), one(1.f), tiny(1e-20f);
    V low(0.f), high(0.f);
    for (std::size_t g = job.first_group; g < job.first_group + job.groups; ++g) {
        const float* const waves = job.waves + g * job.wave_count * 2 * group;
        for (std::size_t lane = 0; lane < group; lane += lanes) {
            const std::size_t at = g * group + lane;
            const V level = V::load_aligned(job.level + at);
            if (!job.has_waves[g]) {
                low = xsimd::min(low, level);
                high = xsimd::max(high, level);
                level.store_aligned(job.height + at);
                none.store_aligned(job.vertical_velocity + at);
                none.store_aligned(job.potential + at);
                level.store_aligned(job.reach + at);
                for (std::size_t i = 0; i < lanes; ++i) job.foam[at + i] = 0;
                continue;
            }
            ShoreSum<Arch> sum;
            for (std::size_t wave = 0; wave < job.wave_count; ++wave)
                sum.add(waves + wave * 2 * group + lane, waves + wave * 2 * group + group + lane, job.moments[wave]);
            const V squared = xsimd::max(sum.h * sum.h + sum.q * sum.q, tiny);
            const V envelope = square_root<Arch>(squared);
            const V max = V::load_aligned(job.highest_envelope + at);
            const auto breaks = envelope > max;
            const V attenuation = xsimd::select(breaks, divided<Arch>(max, envelope), one);
            const V attenuation_t = xsimd::select(
                breaks, none - attenuation * divided<Arch>(sum.h * sum.h_t + sum.q * sum.q_t, squared), none);
            const V h = attenuation * sum.h, q = attenuation * sum.q;
            const V h_t = attenuation * sum.h_t + attenuation_t * sum.h,
                    q_t = attenuation * sum.q_t + attenuation_t * sum.q;
            const V sharpness = V::load_aligned(job.sharpness + at), stands = attenuation * envelope;
            const V height = level + (h + sharpness * (h * h - q * q));
            height.store_aligned(job.height + at);
            (h_t + (sharpness + sharpness) * (h * h_t - q * q_t)).store_aligned(job.vertical_velocity + at);
            (attenuation * sum.potential).store_aligned(job.potential + at);
            (level + (stands + sharpness * (stands * stands))).store_aligned(job.reach + at);
            low = xsimd::min(low, height);
            high = xsimd::max(high, height);

            // Time since the crest passed, as a fraction of a period in [0, 1], from the cosine of
            // the phase and the side of the crest.
            const V cosine = divided<Arch>(sum.h, envelope), quarter(0.25f);
            const V since = xsimd::select(sum.q > none, (V(3.f) + cosine) * quarter, (one - cosine) * quarter);
            const V breaking = divided<Arch>(envelope, V::load_aligned(job.breaking_envelope + at));
            const V over = (breaking - V(ShoreRowsJob::white_from)) * V(1.f / ShoreRowsJob::white_over);
            const V white = xsimd::min(xsimd::max(over, none), one), fading = one - since;
            alignas(64) std::int32_t bytes[lanes];
            xsimd::to_int(V(255.f) * (white * fading) + V(0.5f)).store_aligned(bytes);
            for (std::size_t i = 0; i < lanes; ++i) job.foam[at + i] = static_cast<std::uint8_t>(bytes[i]);
        }
    }
    alignas(64) float lows[lanes], highs[lanes];
    low.store_aligned(lows);
    high.store_aligned(highs);
    *job.lowest = *job.highest = 0;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
        if (lows[lane] < *job.lowest) *job.lowest = lows[lane];
        if (highs[lane] > *job.highest) *job.highest = highs[lane];
    }
}

}  // namespace pelagic::kernels
