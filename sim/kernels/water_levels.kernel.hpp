#pragma once

#include <cstddef>
#include <type_traits>

#include "pelagic/sim/kernels/columns_finalize.kernel.hpp"
#include "pelagic/sim/kernels/evolve_rows.kernel.hpp"
#include "pelagic/simd/interleave.kernel.hpp"

namespace pelagic::kernels {

/// Field of the head, after those of the velocity.
inline constexpr std::size_t field_head = fields;

/// Lines in a grid's texels. Line kz of W columns has the first three pairs in row 2 kz, and the others
/// in row 2 kz + 1: 4 W floats in each. Later row z has the vertical velocity and the head in the place
/// of the last pair of these, then W texels.
enum WaterLine { water_pair_re, water_pair_im, water_rise_re, water_rise_im };

/// Evaluates the velocity and the head of the waves of a pair of groups, and executes the first step of
/// the transform on their fields.
template <class Arch, std::size_t Radix, bool HasNegatives, std::size_t Fields>
PELAGIC_FLATTEN void evolve_water_pair(const WaterRowsJob& job, const VelocityOfWaves<Arch>& of_waves,
                                       std::size_t number, float* data) {
    using V = xsimd::batch<float, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    using C = Complex<Arch>;
    constexpr std::size_t pair_floats = wave_quantities * V::size, point = 2 * V::size, element = Fields * point;

    const float* waves = job.waves + number * Radix * pair_floats;
    const std::uint32_t* harmonics = job.harmonics + number * Radix * V::size;
    const auto plus_wave = [waves](std::size_t s) { return waves + s * pair_floats; };
    const auto minus_wave = [waves](std::size_t s) { return waves + (Radix - 1 - s) * pair_floats; };

    C plus[Radix], minus[Radix], plus_head[Radix], minus_head[Radix];
    for (std::size_t s = 0; s < Radix; ++s) {
        const float *const plus_s = plus_wave(s) + plus_cos_re * V::size,
                           *const minus_s = plus_wave(s) + minus_cos_re * V::size;
        const U harmonic = U::load_aligned(harmonics + s * V::size);
        const Rotation<Arch> phase = of_waves.height(harmonic), rate = of_waves.at(phase, harmonic);
        plus[s] = height_of_wave<Arch>(plus_s, rate);
        if (HasNegatives) minus[Radix - 1 - s] = height_of_wave<Arch>(minus_s, rate);
        if constexpr (Fields > field_head) {
            const V factor = V::load_aligned(job.head_factors + (number * Radix + s) * V::size);
            const Rotation<Arch> head = {phase.sine * factor, phase.cosine * factor};
            plus_head[s] = height_of_wave<Arch>(plus_s, head);
            if (HasNegatives) minus_head[Radix - 1 - s] = height_of_wave<Arch>(minus_s, head);
        }
    }
    const auto transform = [](const C(&velocity)[Radix], [[maybe_unused]] const C(&head)[Radix], auto wave,
                              bool mirrored, float* to) {
        first_step<Arch, Fields>(velocity, velocity, wave, mirrored, to);
        if constexpr (Fields > field_head)
            butterfly<Arch, Radix>([&](std::size_t s) { return head[s]; },
                                   OutputsApart<Arch>{to + field_head * point, element});
    };
    const GroupPair pair = job.fft->pairs[number];
    transform(plus, plus_head, plus_wave, false, data + job.fft->positions[pair.plus] * element);
    if (HasNegatives) transform(minus, minus_head, minus_wave, true, data + job.fft->positions[pair.minus] * element);
}

/// Transposes elements into lines in a grid's texels.
template <class Arch, std::size_t Fields>
struct TransposeWaterLines {
    static constexpr std::size_t lanes = xsimd::batch<float, Arch>::size, element = Fields * 2 * lanes;
    const float* data;
    float* texels;  ///< of the first line
    std::size_t row_floats;

    template <std::size_t Lines>
    PELAGIC_INLINE void of(std::size_t x) const {
        const auto transpose = [&](std::size_t of_element, std::size_t row, std::size_t component) {
            xsimd::batch<float, Arch> block[lanes];
            load_transposed<Arch>(data + x * element + of_element * lanes, element, block);
            float* to = texels + row * row_floats + 4 * x + component * lanes;
            for (std::size_t i = 0; i < Lines; ++i, to += 2 * row_floats) block[i].store_aligned(to);
        };
        transpose(2 * field_p, 0, water_pair_re), transpose(2 * field_p + 1, 0, water_pair_im);
        transpose(2 * field_r, 1, water_pair_re), transpose(2 * field_r + 1, 1, water_pair_im);
        transpose(2 * field_h, 0, water_rise_re), transpose(2 * field_h + 1, 0, water_rise_im);
        if constexpr (Fields > field_head) {
            transpose(2 * field_head, 1, water_rise_re);
            transpose(2 * field_head + 1, 1, water_rise_im);
        }
    }
};

template <class Arch, std::size_t Fields>
inline void water_rows_of(const WaterRowsJob& job) {
    const FftTables& fft = *job.fft;
    float* const data = PELAGIC_STACK_FLOATS(Fields * workspace_floats<Arch>(fft));
    const VelocityOfWaves<Arch> of_waves(job);
    const auto evolve = [&]<std::size_t FirstRadix>(std::integral_constant<std::size_t, FirstRadix>) {
        evolve_and_transform_blocks<Arch, Fields>(fft, data, [&](std::size_t number, auto has_negatives) {
            evolve_water_pair<Arch, FirstRadix, has_negatives.value, Fields>(job, of_waves, number, data);
        });
    };
    if (fft.first_step().radix == 8)
        evolve(std::integral_constant<std::size_t, 8>());
    else
        evolve(std::integral_constant<std::size_t, 4>());

    last_step_of_lines<Arch, Fields>(
        fft, job.line_count, data,
        TransposeWaterLines<Arch, Fields>{data, job.texels + 2 * job.first_line * job.row_floats, job.row_floats});
}

template <class Arch>
void water_rows(const WaterRowsJob& job) {
    if (job.head_factors)
        water_rows_of<Arch, fields + 1>(job);
    else
        water_rows_of<Arch, fields>(job);
}

/// W columns of a grid's texels.
template <class Arch>
struct WaterColumns {
    using V = xsimd::batch<float, Arch>;
    float* texels;
    std::size_t row_floats;
    PELAGIC_INLINE float* row(std::size_t z) const { return texels + z * row_floats; }
    PELAGIC_INLINE V at(std::size_t z, WaterLine component) const {
        return V::load_aligned(row(z) + component * V::size);
    }
};

/// P for positive kz, R with real and imaginary part exchanged for negative kz.
template <class Arch>
struct HorizontalVelocity : WaterColumns<Arch> {
    using C = Complex<Arch>;
    PELAGIC_INLINE C zero() const { return wave(0); }
    PELAGIC_INLINE C wave(std::size_t n) const { return {at(2 * n, water_pair_re), at(2 * n, water_pair_im)}; }
    PELAGIC_INLINE C mirror(std::size_t n) const {
        return {at(2 * n + 1, water_pair_im), at(2 * n + 1, water_pair_re)};
    }
    using WaterColumns<Arch>::at;
};

/// The vertical velocity a and the head b as a + i b (HeightHalfPlane).
template <class Arch, bool HasHead>
struct RiseAndHead : WaterColumns<Arch> {
    using V = xsimd::batch<float, Arch>;
    using C = Complex<Arch>;
    PELAGIC_INLINE C zero() const { return {a(0, water_rise_re), b(0, water_rise_re)}; }
    PELAGIC_INLINE C wave(std::size_t n) const {
        return {a(n, water_rise_re) - b(n, water_rise_im), a(n, water_rise_im) + b(n, water_rise_re)};
    }
    PELAGIC_INLINE C mirror(std::size_t n) const {
        return {a(n, water_rise_re) + b(n, water_rise_im), b(n, water_rise_re) - a(n, water_rise_im)};
    }
    PELAGIC_INLINE V a(std::size_t n, WaterLine component) const { return this->at(2 * n, component); }
    PELAGIC_INLINE V b(std::size_t n, WaterLine component) const {
        return HasHead ? this->at(2 * n + 1, component) : V(0.f);
    }
};

template <class Arch>
void water_columns(const WaterColumnsJob& job) {
    using V = xsimd::batch<float, Arch>;
    using C = Complex<Arch>;
    float* const workspace = PELAGIC_STACK_FLOATS(workspace_floats<Arch>(*job.fft));
    const WaterColumns<Arch> columns{job.texels + 4 * job.first_column, job.row_floats};
    // First, so that the horizontal pair stays in its lines.
    const auto store_rise = [columns](std::size_t z, const C& ab) PELAGIC_INLINE_LAMBDA {
        ab.re.store_aligned(columns.row(z) + water_rise_re * V::size);
        ab.im.store_aligned(columns.row(z) + water_rise_im * V::size);
    };
    if (job.has_head)
        transform_columns<Arch>(*job.fft, workspace, RiseAndHead<Arch, true>{columns}, store_rise);
    else
        transform_columns<Arch>(*job.fft, workspace, RiseAndHead<Arch, false>{columns}, store_rise);

    // The pair is minus the velocity along the cascade's axes.
    const V straight(0.f - job.cosine), crossed(0.f - job.sine);
    transform_columns<Arch>(*job.fft, workspace, HorizontalVelocity<Arch>{columns},
                            [=](std::size_t z, const C& p) PELAGIC_INLINE_LAMBDA {
                                store_interleaved<Arch>(p.re * straight - p.im * crossed,
                                                        columns.at(z, water_rise_re),
                                                        p.re * crossed + p.im * straight,
                                                        columns.at(z, water_rise_im), columns.row(z));
                            });
}

}  // namespace pelagic::kernels
