// Sums over the waves of a sea at given points, wave by wave (sim/exact_water.hpp).
//
// The phase of a wave at a point is m X + n Z turns with 32-bit fractions X and Z of a turn, where
// integer overflow is the range reduction. Its error is at most (m + n) 2^-33 turns.
#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/wave_sum_jobs.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/exact.kernel.hpp"
#include "pelagic/simd/exponential.kernel.hpp"
#include "pelagic/simd/same_bits.kernel.hpp"
#include "pelagic/simd/turns.kernel.hpp"

namespace pelagic::kernels {

/// Adds floats in a fixed order, in double precision.
template <class Arch>
PELAGIC_INLINE double total_of(const float* partial) {
    double total = 0;
    for (std::size_t i = 0; i < WaveBlock::partial_sums; ++i) total += static_cast<double>(partial[i]);
    return total;
}

template <class Arch>
void move_waves(const MoveWavesJob& job) {
    using V = xsimd::batch<float, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    const U fraction(job.fraction);
    for (std::size_t i = 0; i < job.count; i += V::size) {
        const auto [sine, cosine] = rotation_of_turns<Arch>(U::load_aligned(job.harmonics + i) * fraction);
        const auto packed = [&job, i](std::size_t part) { return V::load_aligned(job.packed[part] + i); };
        const V factor = V::load_aligned(job.flow_factor + i);
        (packed(0) * cosine + packed(2) * sine).store_aligned(job.head_re + i);
        (packed(1) * cosine + packed(3) * sine).store_aligned(job.head_im + i);
        ((packed(1) * sine - packed(3) * cosine) * factor).store_aligned(job.flow_re + i);
        ((packed(2) * cosine - packed(0) * sine) * factor).store_aligned(job.flow_im + i);
    }
}

template <class Arch, bool HasMirror>
PELAGIC_FLATTEN double height_of_block(const WaveBlock& waves, std::uint32_t x, std::uint32_t z) {
    using V = xsimd::batch<float, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    alignas(64) float partial[WaveBlock::partial_sums];
    const U at_x(x), at_z(z);
    for (std::size_t lane = 0; lane < WaveBlock::partial_sums; lane += V::size) {
        V sum(0.f);
        for (std::size_t i = lane; i < waves.count; i += WaveBlock::partial_sums) {
            const U m = U::load_aligned(waves.m + i), n = U::load_aligned(waves.n + i);
            const auto [sine, cosine] = rotation_of_turns<Arch>(m * at_x + n * at_z);
            V height = V::load_aligned(waves.head_re + i) * cosine - V::load_aligned(waves.head_im + i) * sine;
            if constexpr (HasMirror) height = height * (V(1.f) + V::load_aligned(waves.mirror + i));
            sum = sum + height;
        }
        sum.store_aligned(partial + lane);
    }
    return total_of<Arch>(partial);
}

template <class Arch>
void sum_heights(const SumHeightsJob& job) {
    for (std::size_t point = 0; point < job.points; ++point)
        job.heights[point] += job.waves.mirror ? height_of_block<Arch, true>(job.waves, job.x[point], job.z[point])
                                               : height_of_block<Arch, false>(job.waves, job.x[point], job.z[point]);
}

template <class Arch, bool HasMirror>
PELAGIC_FLATTEN void add_block(const WaveBlock& waves, std::uint32_t x, std::uint32_t z, float decay, double* all) {
    using Job = SumWaterJob;
    using V = xsimd::batch<float, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;
    alignas(64) float partial[Job::sums][WaveBlock::partial_sums];
    const U at_x(x), at_z(z);
    const V of_step(decay);
    for (std::size_t lane = 0; lane < WaveBlock::partial_sums; lane += V::size) {
        V head(0.f), along(0.f), across(0.f), up(0.f), slope_along(0.f), slope_across(0.f), slope_up(0.f);
        for (std::size_t i = lane; i < waves.count; i += WaveBlock::partial_sums) {
            const U m = U::load_aligned(waves.m + i), n = U::load_aligned(waves.n + i);
            const V steps = V::load_aligned(waves.steps + i);
            const auto [sine, cosine] = rotation_of_turns<Arch>(m * at_x + n * at_z);
            V level = falling_exponential<Arch>(steps * of_step), upright = level;
            if constexpr (HasMirror) {
                const V other = divided<Arch>(V::load_aligned(waves.mirror + i), level);
                upright = level - other;
                level = level + other;
            }
            const V head_re = V::load_aligned(waves.head_re + i), head_im = V::load_aligned(waves.head_im + i);
            const V flow_re = V::load_aligned(waves.flow_re + i), flow_im = V::load_aligned(waves.flow_im + i);
            const V cos_head = head_re * cosine - head_im * sine;
            const V sin_head = (head_re * sine + head_im * cosine) * level;
            const V cos_flow = (flow_re * cosine - flow_im * sine) * level;
            const V sin_flow = flow_re * sine + flow_im * cosine;
            const V steps_x = xsimd::to_float(same_bits<I>(m)), steps_z = xsimd::to_float(same_bits<I>(n));
            const V steps_up = steps * upright;
            head = head + cos_head * level;
            along = along + steps_x * cos_flow;
            across = across + steps_z * cos_flow;
            up = up + steps_up * sin_flow;
            slope_along = slope_along + steps_x * sin_head;
            slope_across = slope_across + steps_z * sin_head;
            slope_up = slope_up + steps_up * cos_head;
        }
        head.store_aligned(partial[Job::head] + lane);
        along.store_aligned(partial[Job::along] + lane);
        across.store_aligned(partial[Job::across] + lane);
        up.store_aligned(partial[Job::up] + lane);
        slope_along.store_aligned(partial[Job::slope_along] + lane);
        slope_across.store_aligned(partial[Job::slope_across] + lane);
        slope_up.store_aligned(partial[Job::slope_up] + lane);
    }
    for (std::size_t sum = 0; sum < Job::sums; ++sum) all[sum] += total_of<Arch>(partial[sum]);
}

template <class Arch>
void sum_water(const SumWaterJob& job) {
    for (std::size_t point = 0; point < job.points; ++point) {
        if (job.decay[point] * job.waves.steps[0] > SumWaterJob::max_decay) continue;
        double* const all = job.all + point * SumWaterJob::sums;
        if (job.waves.mirror)
            add_block<Arch, true>(job.waves, job.x[point], job.z[point], job.decay[point], all);
        else
            add_block<Arch, false>(job.waves, job.x[point], job.z[point], job.decay[point], all);
    }
}

}  // namespace pelagic::kernels
