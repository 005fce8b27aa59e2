#pragma once

#include <cstddef>
#include <cstdint>

#include "pelagic/sim/kernels/fft.kernel.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/transpose.kernel.hpp"
#include "pelagic/simd/turns.kernel.hpp"

namespace pelagic::kernels {

/// The three fields that a wave adds to, as wave_blocks.hpp says.
enum Field { field_h, field_p, field_r, fields };

/// A wave's height at this moment, from the four rows of S' at `packed`.
template <class Arch>
PELAGIC_INLINE Complex<Arch> height_of_wave(const float* packed, const Rotation<Arch>& rotation) {
    using V = xsimd::batch<float, Arch>;
    const auto row = [packed](std::size_t i) { return V::load_aligned(packed + i * V::size); };
    return {row(0) * rotation.cosine + row(2) * rotation.sine, row(1) * rotation.cosine + row(3) * rotation.sine};
}

/// What multiplies a wave's S'_xy and S'_zw: cosine and sine of its phase for the height,
template <class Arch>
struct HeightOfWaves {
    using V = xsimd::batch<float, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    explicit HeightOfWaves(const EvolveRowsJob& job) : fraction(job.fraction) {}
    PELAGIC_INLINE Rotation<Arch> operator()(U harmonic) const {
        return rotation_of_turns<Arch>(harmonic * fraction);
    }
    U fraction;
};

/// and their derivatives in time for the velocity. The phase grows by the wave's own frequency in the loop.
template <class Arch>
struct VelocityOfWaves {
    using V = xsimd::batch<float, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    explicit VelocityOfWaves(const EvolveRowsJob& job)
        : height(job), first_frequency(job.first_frequency), minus_first_frequency(0.f - job.first_frequency) {}
    PELAGIC_INLINE Rotation<Arch> operator()(U harmonic) const {
        const Rotation<Arch> phase = height(harmonic);
        const V periods = xsimd::to_float(xsimd::bitwise_cast<xsimd::batch<std::int32_t, Arch>>(harmonic));
        return {phase.cosine * (periods * first_frequency), phase.sine * (periods * minus_first_frequency)};
    }
    HeightOfWaves<Arch> height;
    V first_frequency, minus_first_frequency;
};

/// Takes the waves of one group, whose heights are `h`, through the first step of the three transforms. `wave(s)` are
/// the quantities of the s-th one; `mirrored` if it stands there as (-kx, kz).
///
/// i h along x and z are (-x_im, x_re) and (-z_im, z_re); from them P = -(Dx + i Dz), R = -i (Dx - i Dz).
template <class Arch, std::size_t Radix, class Wave>
PELAGIC_INLINE void first_step(Complex<Arch> (&h)[Radix], Wave wave, bool mirrored, std::size_t position,
                               float* const (&data)[fields]) {
    using V = xsimd::batch<float, Arch>;
    constexpr std::size_t element = 2 * V::size;
    Complex<Arch> p[Radix], r[Radix];
    for (std::size_t s = 0; s < Radix; ++s) {
        const V along = V::load_aligned(wave(s) + direction_x * V::size);
        const V x = mirrored ? V(0.f) - along : along;
        const V z = V::load_aligned(wave(s) + direction_z * V::size);
        const V x_re = x * h[s].re, x_im = x * h[s].im;
        const V z_re = z * h[s].re, z_im = z * h[s].im;
        p[s].re = x_im + z_re;
        p[s].im = z_im - x_re;
        r[s].re = x_re + z_im;
        r[s].im = x_im - z_re;
    }
    butterfly<Arch>(h);
    for (std::size_t s = 0; s < Radix; ++s) h[s].store(data[field_h] + (position + s) * element);
    butterfly<Arch>(p);
    for (std::size_t s = 0; s < Radix; ++s) p[s].store(data[field_p] + (position + s) * element);
    butterfly<Arch>(r);
    for (std::size_t s = 0; s < Radix; ++s) r[s].store(data[field_r] + (position + s) * element);
}

/// Evolves the waves of a pair of groups and takes their fields through the first step of the transform.
template <class Arch, std::size_t Radix, class OfWaves>
inline void evolve_group_pair(const EvolveRowsJob& job, std::size_t number, float* const (&data)[fields]) {
    using V = xsimd::batch<float, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    constexpr std::size_t pair_floats = wave_quantities * V::size;

    const GroupPair pair = job.fft->pairs[number];
    const bool has_negatives = !pair.is_own_negative();
    const float* waves = job.waves + number * Radix * pair_floats;
    const std::uint32_t* harmonics = job.harmonics + number * Radix * V::size;
    const OfWaves of_waves(job);
    const auto rotation = [&](std::size_t s) { return of_waves(U::load_aligned(harmonics + s * V::size)); };
    const auto plus_wave = [waves](std::size_t s) { return waves + s * pair_floats; };
    const auto minus_wave = [waves](std::size_t s) { return waves + (Radix - 1 - s) * pair_floats; };

    Complex<Arch> plus[Radix], minus[Radix];
    for (std::size_t s = 0; s < Radix; ++s) {
        const Rotation<Arch> turned = rotation(s);
        plus[s] = height_of_wave<Arch>(plus_wave(s) + plus_cos_re * V::size, turned);
        if (has_negatives) minus[Radix - 1 - s] = height_of_wave<Arch>(plus_wave(s) + minus_cos_re * V::size, turned);
    }
    first_step<Arch>(plus, plus_wave, false, job.fft->positions[pair.plus], data);
    if (has_negatives) first_step<Arch>(minus, minus_wave, true, job.fft->positions[pair.minus], data);
}

/// All steps but the last. The last one joins parts by the remainder of kx; a part and its negative are evolved and
/// transformed together, while they are in the first cache.
template <class Arch, std::size_t FirstRadix, class OfWaves>
inline void evolve_and_transform_parts(const EvolveRowsJob& job, float* const (&data)[fields]) {
    const FftTables& fft = *job.fft;
    const std::size_t parts = static_cast<std::size_t>(fft.last_step().radix);
    const std::size_t part_floats =
        static_cast<std::size_t>(fft.last_step().span) * 2 * xsimd::batch<float, Arch>::size;

    for (std::size_t part = 0; part <= parts / 2; ++part) {
        for (std::size_t number = fft.first_pair[part]; number < fft.first_pair[part + 1]; ++number)
            evolve_group_pair<Arch, FirstRadix, OfWaves>(job, number, data);
        const std::size_t negative = (parts - part) % parts;
        for (float* field : data) {
            middle_steps<Arch>(field + part * part_floats, fft);
            if (negative != part) middle_steps<Arch>(field + negative * part_floats, fft);
        }
    }
}

/// Puts W elements of W transformed lines, from x on, where the columns want them: x is the lane now.
template <class Arch>
inline void turn_lines(const float* data, const EvolveRowsJob& job, std::size_t x, LineComponent re,
                       LineComponent im) {
    using V = xsimd::batch<float, Arch>;
    constexpr std::size_t element = 2 * V::size;
    constexpr std::size_t row = line_components * V::size;
    float* lines = job.lines + x / V::size * column_block_floats(job.fft->size, V::size) + job.first_line * row;
    for (std::size_t part = 0; part < 2; ++part) {
        V block[V::size];
        load_transposed<Arch>(data + x * element + part * V::size, element, block);
        float* to = lines + (part == 0 ? re : im) * V::size;
        if (job.line_count == V::size) {  // nearly always, and then without a loop
            for (std::size_t i = 0; i < V::size; ++i) block[i].store_aligned(to + i * row);
        } else {
            for (std::size_t i = 0; i < job.line_count; ++i) block[i].store_aligned(to + i * row);
        }
    }
}

/// The last step of the three fields. As soon as W elements that are neighbours in x are done, they are turned: rows of
/// lines are written whole, once.
template <class Arch, std::size_t Radix>
inline void last_step_turned(const EvolveRowsJob& job, float* const (&data)[fields]) {
    constexpr std::size_t lanes = xsimd::batch<float, Arch>::size;
    constexpr LineComponent re[fields] = {height_re, p_re, r_re}, im[fields] = {height_im, p_im, r_im};
    const FftTables& fft = *job.fft;
    const FftStep& step = fft.last_step();
    const std::size_t span = static_cast<std::size_t>(step.span);
    const std::size_t chunk = span < lanes ? span : lanes;
    const auto turn = [&](std::size_t x) {
        for (int field = 0; field < fields; ++field) turn_lines<Arch>(data[field], job, x, re[field], im[field]);
    };
    for (std::size_t j = 0; j < span; j += chunk) {
        for (float* field : data)
            fft_group<Arch, Radix>(field, span, j, j + chunk, fft.twiddles + step.first_twiddle);
        if (chunk == lanes)
            for (std::size_t k = 0; k < Radix; ++k) turn(k * span + j);
    }
    if (chunk < lanes)
        for (std::size_t x = 0; x < Radix * span; x += lanes) turn(x);
}

template <class Arch, class OfWaves>
inline void evolve_lines(const EvolveRowsJob& job) {
    const FftTables& fft = *job.fft;
    const std::size_t floats = workspace_floats<Arch>(fft);
    float* const workspace = PELAGIC_STACK_FLOATS(fields * floats);
    float* const data[fields] = {workspace, workspace + floats, workspace + 2 * floats};

    if (fft.first_step().radix == 8)
        evolve_and_transform_parts<Arch, 8, OfWaves>(job, data);
    else
        evolve_and_transform_parts<Arch, 4, OfWaves>(job, data);

    if (fft.last_step().radix == 8)
        last_step_turned<Arch, 8>(job, data);
    else
        last_step_turned<Arch, 4>(job, data);
}

template <class Arch>
void evolve_rows(const EvolveRowsJob& job) {
    evolve_lines<Arch, HeightOfWaves<Arch>>(job);
}

template <class Arch>
void evolve_velocity_rows(const EvolveRowsJob& job) {
    evolve_lines<Arch, VelocityOfWaves<Arch>>(job);
}

}  // namespace pelagic::kernels
