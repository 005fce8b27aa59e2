#pragma once

#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "pelagic/sim/kernels/fft.kernel.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/same_bits.kernel.hpp"
#include "pelagic/simd/transpose.kernel.hpp"
#include "pelagic/simd/turns.kernel.hpp"

namespace pelagic::kernels {

/// The three fields to which each wave contributes (wave_blocks.hpp).
enum Field { field_h, field_p, field_r, fields };

/// Returns the wave's height at the job's moment, from the four rows of S' at `packed`.
template <class Arch>
PELAGIC_INLINE Complex<Arch> height_of_wave(const float* packed, const Rotation<Arch>& rotation) {
    using V = xsimd::batch<float, Arch>;
    const auto row = [packed](std::size_t i) { return V::load_aligned(packed + i * V::size); };
    return {row(0) * rotation.cosine + row(2) * rotation.sine, row(1) * rotation.cosine + row(3) * rotation.sine};
}

/// Returns the rotation by a phase plus the angle of a lean, over the cosine of the lean.
template <class Arch>
PELAGIC_INLINE Rotation<Arch> leaning(const Rotation<Arch>& phase, const xsimd::batch<float, Arch>& tangent) {
    return {phase.sine + tangent * phase.cosine, phase.cosine - tangent * phase.sine};
}

/// Returns the factors of a wave's S'_xy and S'_zw for its height: cosine and sine of its phase.
template <class Arch>
struct HeightOfWaves {
    using V = xsimd::batch<float, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    template <class Job>
    explicit HeightOfWaves(const Job& job) : fraction(job.fraction) {}
    PELAGIC_INLINE Rotation<Arch> operator()(U harmonic) const {
        return rotation_of_turns<Arch>(harmonic * fraction);
    }
    U fraction;
};

/// Returns the factors of a wave's S'_xy and S'_zw for its velocity: the time derivatives of cosine
/// and sine. The phase rate is the wave's quantised frequency in the loop.
template <class Arch>
struct VelocityOfWaves {
    using V = xsimd::batch<float, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    template <class Job>
    explicit VelocityOfWaves(const Job& job)
        : height(job), first_frequency(job.first_frequency), minus_first_frequency(0.f - job.first_frequency) {}
    PELAGIC_INLINE Rotation<Arch> operator()(U harmonic) const { return at(height(harmonic), harmonic); }
    PELAGIC_INLINE Rotation<Arch> at(const Rotation<Arch>& phase, U harmonic) const {
        const V periods = xsimd::to_float(same_bits<xsimd::batch<std::int32_t, Arch>>(harmonic));
        return {phase.cosine * (periods * first_frequency), phase.sine * (periods * minus_first_frequency)};
    }
    HeightOfWaves<Arch> height;
    V first_frequency, minus_first_frequency;
};

/// The waves of one group: h and d of EvolveRowsJob, where the direction has the cosine of the lean.
template <class Arch, std::size_t Radix>
struct EvolvedGroup {
    Complex<Arch> h[Radix], d[Radix];
};

/// Executes the first step of the three transforms on the waves of one group.
/// \tparam Fields  of each element of the data
/// \param wave  wave(s) returns the quantities of wave s
/// \param mirrored  true if the group has the waves (-kx, kz)
///
/// The products of i d with the directions along x and z are (-x_im, x_re) and (-z_im, z_re). They
/// give P = -(Dx + i Dz), R = -i (Dx - i Dz).
template <class Arch, std::size_t Fields = fields, std::size_t Radix, class Wave>
PELAGIC_INLINE void first_step(const Complex<Arch> (&h)[Radix], const Complex<Arch> (&d)[Radix], Wave wave,
                               bool mirrored, float* to) {
    using V = xsimd::batch<float, Arch>;
    using C = Complex<Arch>;
    constexpr std::size_t point = 2 * V::size, element = Fields * point;
    butterfly<Arch, Radix>([&](std::size_t s) { return h[s]; },
                           OutputsApart<Arch>{to + field_h * point, element});
    C p[Radix], r[Radix];
    for (std::size_t s = 0; s < Radix; ++s) {
        const V along = V::load_aligned(wave(s) + direction_x * V::size);
        const V x = mirrored ? V(0.f) - along : along;
        const V z = V::load_aligned(wave(s) + direction_z * V::size);
        const V x_re = x * d[s].re, x_im = x * d[s].im;
        const V z_re = z * d[s].re, z_im = z * d[s].im;
        p[s] = {x_im + z_re, z_im - x_re};
        r[s] = {x_re + z_im, x_im - z_re};
    }
    butterfly<Arch, Radix>([&](std::size_t s) { return p[s]; }, OutputsApart<Arch>{to + field_p * point, element});
    butterfly<Arch, Radix>([&](std::size_t s) { return r[s]; }, OutputsApart<Arch>{to + field_r * point, element});
}

/// Evaluates the waves of a pair of groups and executes the first step of the transform on their
/// fields.
template <class Arch, std::size_t Radix, bool HasNegatives, class OfWaves>
PELAGIC_FLATTEN void evolve_group_pair(const EvolveRowsJob& job, const OfWaves& of_waves, std::size_t number,
                                       float* data) {
    using V = xsimd::batch<float, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    constexpr std::size_t pair_floats = wave_quantities * V::size, element = fields * 2 * V::size;

    const float* waves = job.waves + number * Radix * pair_floats;
    const std::uint32_t* harmonics = job.harmonics + number * Radix * V::size;
    const auto plus_wave = [waves](std::size_t s) { return waves + s * pair_floats; };
    const auto minus_wave = [waves](std::size_t s) { return waves + (Radix - 1 - s) * pair_floats; };

    EvolvedGroup<Arch, Radix> plus, minus;
    for (std::size_t s = 0; s < Radix; ++s) {
        const float* const wave = plus_wave(s);
        const Rotation<Arch> rotation = of_waves(U::load_aligned(harmonics + s * V::size));
        const Rotation<Arch> leant = leaning<Arch>(rotation, V::load_aligned(wave + lean_tangent * V::size));
        plus.h[s] = height_of_wave<Arch>(wave + plus_cos_re * V::size, rotation);
        plus.d[s] = height_of_wave<Arch>(wave + plus_cos_re * V::size, leant);
        if (!HasNegatives) continue;
        minus.h[Radix - 1 - s] = height_of_wave<Arch>(wave + minus_cos_re * V::size, rotation);
        minus.d[Radix - 1 - s] = height_of_wave<Arch>(wave + minus_cos_re * V::size, leant);
    }
    const GroupPair pair = job.fft->pairs[number];
    first_step<Arch>(plus.h, plus.d, plus_wave, false, data + job.fft->positions[pair.plus] * element);
    if (HasNegatives) first_step<Arch>(minus.h, minus.d, minus_wave, true, data + job.fft->positions[pair.minus] * element);
}

/// Executes all steps except the last. The last step combines subtransforms by the remainder of kx.
/// A subtransform and its negative are evaluated and transformed together, while their data is in
/// the first-level cache.
/// \param evolve_pair  evolve_pair(number, has_negatives) evaluates a pair of groups
template <class Arch, std::size_t Fields, class EvolvePair>
inline void evolve_and_transform_blocks(const FftTables& fft, float* data, EvolvePair evolve_pair) {
    constexpr std::size_t element = Fields * 2 * xsimd::batch<float, Arch>::size;
    const std::size_t blocks = static_cast<std::size_t>(fft.last_step().radix);
    const std::size_t block_size = static_cast<std::size_t>(fft.last_step().span);

    for (std::size_t block = 0; block <= blocks / 2; ++block) {
        for (std::size_t number = fft.first_pair[block]; number < fft.first_pair[block + 1]; ++number) {
            if (fft.pairs[number].is_own_negative())
                evolve_pair(number, std::false_type());
            else
                evolve_pair(number, std::true_type());
        }
        const std::size_t negative = (blocks - block) % blocks;
        middle_steps<Arch, Fields>(data + block * block_size * element, block_size, fft);
        if (negative != block) middle_steps<Arch, Fields>(data + negative * block_size * element, block_size, fft);
    }
}

/// Transposes W elements of the first `Lines` transformed lines, starting at `data`, into the
/// column blocks: x becomes the lane.
template <class Arch, std::size_t Lines>
PELAGIC_INLINE void transpose_lines(const float* data, float* lines) {
    using V = xsimd::batch<float, Arch>;
    constexpr std::size_t element = line_components * V::size;
    const auto transpose = [=](std::size_t offset, LineComponent component) {
        V block[V::size];
        load_transposed<Arch>(data + offset * V::size, element, block);
        for (std::size_t i = 0; i < Lines; ++i) block[i].store_aligned(lines + i * element + component * V::size);
    };
    transpose(0, height_re), transpose(1, height_im);
    transpose(2, p_re), transpose(3, p_im);
    transpose(4, r_re), transpose(5, r_im);
}

/// Executes the last step of all fields. As soon as W adjacent elements along x are complete, they are
/// transposed, so that each row of lines is written once and as a whole.
/// \tparam Lines  number of lines in a block
/// \param transpose  transpose.of<Lines>(x) stores W elements of each line from x on
template <class Arch, std::size_t Radix, std::size_t Fields, std::size_t Lines, class Transpose>
PELAGIC_FLATTEN void last_step_transposed(const FftTables& fft, float* data, const Transpose transpose) {
    constexpr std::size_t lanes = xsimd::batch<float, Arch>::size;
    constexpr std::size_t point = 2 * lanes, element = Fields * point;
    const FftStep& step = fft.last_step();
    const std::size_t span = static_cast<std::size_t>(step.span);
    const std::size_t chunk = span < lanes ? span : lanes;
    const float* roots = fft.twiddles + step.first_twiddle;
    for (std::size_t first = 0; first < span; first += chunk) {
        for (std::size_t j = first; j < first + chunk; ++j, roots += 2 * Radix)
            for (std::size_t field = 0; field < Fields; ++field)
                join<Arch, Radix>(data + j * element + field * point, span * element, roots);
        if (chunk == lanes)
            for (std::size_t k = 0; k < Radix; ++k) transpose.template of<Lines>(k * span + first);
    }
    if (chunk < lanes)
        for (std::size_t x = 0; x < Radix * span; x += lanes) transpose.template of<Lines>(x);
}

/// As above. \param line_count  W, or W/2 if N = 16 and W = 16
template <class Arch, std::size_t Fields, class Transpose>
inline void last_step_of_lines(const FftTables& fft, std::size_t line_count, float* data, const Transpose transpose) {
    constexpr std::size_t lanes = xsimd::batch<float, Arch>::size;
    if (fft.last_step().radix == 8)
        last_step_transposed<Arch, 8, Fields, lanes>(fft, data, transpose);
    else if (line_count == lanes)
        last_step_transposed<Arch, 4, Fields, lanes>(fft, data, transpose);
    else
        last_step_transposed<Arch, 4, Fields, lanes / 2>(fft, data, transpose);
}

/// Transposes elements into column blocks.
template <class Arch>
struct TransposeLines {
    static constexpr std::size_t lanes = xsimd::batch<float, Arch>::size;
    const float* data;
    float* lines;
    std::size_t column_block;  ///< floats

    template <std::size_t Lines>
    PELAGIC_INLINE void of(std::size_t x) const {
        transpose_lines<Arch, Lines>(data + x * fields * 2 * lanes, lines + x / lanes * column_block);
    }
};

template <class Arch, class OfWaves>
inline void evolve_lines(const EvolveRowsJob& job) {
    constexpr std::size_t lanes = xsimd::batch<float, Arch>::size, element = line_components * lanes;
    const FftTables& fft = *job.fft;
    float* const data = PELAGIC_STACK_FLOATS(fields * workspace_floats<Arch>(fft));
    const OfWaves of_waves(job);
    const auto evolve = [&]<std::size_t FirstRadix>(std::integral_constant<std::size_t, FirstRadix>) {
        evolve_and_transform_blocks<Arch, fields>(fft, data, [&](std::size_t number, auto has_negatives) {
            evolve_group_pair<Arch, FirstRadix, has_negatives.value>(job, of_waves, number, data);
        });
    };
    if (fft.first_step().radix == 8)
        evolve(std::integral_constant<std::size_t, 8>());
    else
        evolve(std::integral_constant<std::size_t, 4>());

    last_step_of_lines<Arch, fields>(
        fft, job.line_count, data,
        TransposeLines<Arch>{data, job.lines + job.first_line * element, column_block_floats(fft.size, lanes)});
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
