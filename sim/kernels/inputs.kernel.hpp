// Wave inputs: adds grid waves and ring waves to a row of texels, and adds rows to the blocks of a
// surface.
#pragma once

#include <xsimd/xsimd.hpp>

#include "pelagic/sim/kernels/columns_finalize.kernel.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/simd/exact.kernel.hpp"
#include "pelagic/simd/same_bits.kernel.hpp"
#include "pelagic/simd/turns.kernel.hpp"

namespace pelagic::kernels {

template <class Arch>
void add_waves(const AddWavesJob& job) {
    using V = xsimd::batch<float, Arch>;
    for (std::size_t column = 0; column < job.columns; column += V::size) {
        V dx = V::load_aligned(job.rows[0] + column), height = V::load_aligned(job.rows[1] + column),
          dz = V::load_aligned(job.rows[2] + column);
        for (std::size_t i = 0; i < job.count; ++i) {
            const GridWaveRow& wave = job.waves[i];
            const V cosine = V::load_aligned(wave.cosine + column), sine = V::load_aligned(wave.sine + column);
            dx = dx + (V(wave.of_cosine[0]) * cosine + V(wave.of_sine[0]) * sine);
            height = height + (V(wave.of_cosine[1]) * cosine + V(wave.of_sine[1]) * sine);
            dz = dz + (V(wave.of_cosine[2]) * cosine + V(wave.of_sine[2]) * sine);
        }
        dx.store_aligned(job.rows[0] + column);
        height.store_aligned(job.rows[1] + column);
        dz.store_aligned(job.rows[2] + column);
    }
}

template <class Arch>
void add_ripple(const AddRippleJob& job) {
    using V = xsimd::batch<float, Arch>;
    using I = xsimd::batch<std::int32_t, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    const V half(job.half_wave), reach_squared(job.reach_squared);
    for (std::size_t column = 0; column < job.columns; column += V::size) {
        const V squared = V::load_aligned(job.along_squared + column) + V(job.across_squared);
        const V within = xsimd::max(V(1.f) - divided<Arch>(squared, reach_squared), V(0.f)), fade = within * within;
        const V slant = square_root<Arch>(squared + half * half);
        const V envelope = fade * square_root<Arch>(divided<Arch>(half, slant));
        const V waves = (slant - half) * V(job.waves_per_m);
        // The fraction of a turn is exact and below 1, so its product with 2^31 fits a signed
        // integer.
        const V fraction = waves - xsimd::to_float(xsimd::to_int(waves));
        const I half_turns = xsimd::to_int(fraction * V(0x1p31f));
        const Rotation<Arch> at = rotation_of_turns<Arch>(same_bits<U>(half_turns + half_turns) + U(job.start));
        (V::load_aligned(job.heights + column) + V(job.amplitude) * (envelope * at.cosine))
            .store_aligned(job.heights + column);
        if (job.vertical_velocities)
            (V::load_aligned(job.vertical_velocities + column) + V(job.vertical_velocity) * (envelope * at.sine))
                .store_aligned(job.vertical_velocities + column);
    }
}

/// Returns false and writes nothing if a value is too large or NaN.
template <class Arch>
bool add_rows(const AddRowsJob& job) {
    using V = xsimd::batch<float, Arch>;
    const std::size_t n = job.resolution, texels = n * job.row_count;
    V wrong(0.f);
    for (const float* const row : job.rows)
        for (std::size_t i = 0; i < texels; i += V::size)
            wrong = wrong + xsimd::select(xsimd::abs(V::load_aligned(row + i)) <= V(job.max), V(0.f), V(1.f));
    if (max_lane<Arch>(wrong) > 0) return false;

    V min(3.4e38f), max(-3.4e38f), max_x(0.f), max_z(0.f);
    for (std::size_t column = 0; column < n; column += V::size) {
        float* const block = job.surface + column / V::size * job.block_stride;
        for (std::size_t row = 0; row < job.row_count; ++row) {
            float* const to = block + (job.first_row + row) * surface_components * V::size;
            const auto sum = [&](std::size_t field) {
                const V both =
                    V::load_aligned(to + field * V::size) + V::load_aligned(job.rows[field] + row * n + column);
                both.store_aligned(to + field * V::size);
                return both;
            };
            const V dx = sum(surface_dx), height = sum(surface_height), dz = sum(surface_dz);
            min = xsimd::min(min, height);
            max = xsimd::max(max, height);
            max_x = xsimd::max(max_x, xsimd::abs(dx));
            max_z = xsimd::max(max_z, xsimd::abs(dz));
        }
    }
    // Instruction sets differ in the minimum of +0 and -0; adding 0 makes the result +0.
    *job.bounds = {min_lane<Arch>(min) + 0.f, max_lane<Arch>(max) + 0.f, max_lane<Arch>(max_x),
                   max_lane<Arch>(max_z)};
    return true;
}

}  // namespace pelagic::kernels
