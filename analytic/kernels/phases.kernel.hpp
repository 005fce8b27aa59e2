// Phases of waves at points, from doubles to 32-bit integers in which 2^32 is a full turn (the
// input of rotation_of_turns()).
//
// With doubles, a phase is within 2^-32 of a turn up to 1e6 turns from the origin. Whole turns are
// subtracted first. The fraction is added to 1.5 x 2^20; the lower word of the sum is then the
// fraction in units of 2^-32.
#pragma once

#include <cstddef>
#include <cstdint>
#include <xsimd/xsimd.hpp>

#include "pelagic/analytic/kernels/analytic_kernels.hpp"
#include "pelagic/simd/always_inline.hpp"
#include "pelagic/simd/lanes.kernel.hpp"
#include "pelagic/simd/same_bits.kernel.hpp"

namespace pelagic::kernels {

/// Returns the lower words of two registers of doubles, in order.
#if defined(__AVX512F__)
template <HasLanes<16> Arch>
PELAGIC_INLINE xsimd::batch<std::uint32_t, Arch> lower_words(xsimd::batch<double, Arch> a,
                                                             xsimd::batch<double, Arch> b) {
    const __m512i even = _mm512_setr_epi32(0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
    return _mm512_permutex2var_epi32(_mm512_castpd_si512(a), even, _mm512_castpd_si512(b));
}
#endif
#if defined(__AVX2__)
template <HasLanes<8> Arch>
PELAGIC_INLINE xsimd::batch<std::uint32_t, Arch> lower_words(xsimd::batch<double, Arch> a,
                                                             xsimd::batch<double, Arch> b) {
    // Lanes: a01 b01 a23 b23.
    const __m256 halves = _mm256_shuffle_ps(_mm256_castpd_ps(a), _mm256_castpd_ps(b), _MM_SHUFFLE(2, 0, 2, 0));
    return _mm256_permute4x64_epi64(_mm256_castps_si256(halves), _MM_SHUFFLE(3, 1, 2, 0));
}
#endif
#if defined(__SSE4_2__)
template <HasLanes<4> Arch>
PELAGIC_INLINE xsimd::batch<std::uint32_t, Arch> lower_words(xsimd::batch<double, Arch> a,
                                                             xsimd::batch<double, Arch> b) {
    return _mm_castps_si128(_mm_shuffle_ps(_mm_castpd_ps(a), _mm_castpd_ps(b), _MM_SHUFFLE(2, 0, 2, 0)));
}
#else
template <class Arch>
PELAGIC_INLINE xsimd::batch<std::uint32_t, Arch> lower_words(xsimd::batch<double, Arch> a,
                                                             xsimd::batch<double, Arch> b) {
    return vuzp1q_u32(vreinterpretq_u32_f64(a), vreinterpretq_u32_f64(b));
}
#endif

/// Phases of all waves at W points, on the stack. Each step of a search reads them.
template <class Arch>
class PointPhases {
    using U = xsimd::batch<std::uint32_t, Arch>;
    using D = xsimd::batch<double, Arch>;

   public:
    /// \param terms  `count` elements of a type with a WavePhase `phase`
    template <class Terms>
    PELAGIC_INLINE PointPhases(const Terms* terms, const double* starts, int count, const double* x,
                               const double* z) {
        const D x_low = D::load_unaligned(x), x_high = D::load_unaligned(x + D::size);
        const D z_low = D::load_unaligned(z), z_high = D::load_unaligned(z + D::size);
        for (int i = 0; i < count; ++i) {
            const D per_x(terms[i].phase.turns_per_m_x), per_z(terms[i].phase.turns_per_m_z), start(starts[i]);
            lower_words<Arch>(fixed_point(x_low * per_x + z_low * per_z + start),
                              fixed_point(x_high * per_x + z_high * per_z + start))
                .store_aligned(phases_ + static_cast<std::size_t>(i) * U::size);
        }
    }

    PELAGIC_INLINE U of(int wave) const {
        return U::load_aligned(phases_ + static_cast<std::size_t>(wave) * U::size);
    }

   private:
    PELAGIC_INLINE static D fixed_point(D turns) {
        const D to_whole(0x1.8p52);
        const D whole = (turns + to_whole) - to_whole;
        return (turns - whole) + D(0x1.8p20);
    }

    alignas(64) std::uint32_t phases_[max_analytic_waves * U::size];
};

/// Converts turns to a phase. \pre |turns| is at most a few thousand
template <class Arch>
PELAGIC_INLINE xsimd::batch<std::uint32_t, Arch> phase_of_turns(xsimd::batch<float, Arch> turns) {
    using V = xsimd::batch<float, Arch>;
    using U = xsimd::batch<std::uint32_t, Arch>;
    const V to_whole(0x1.8p23f);
    const V fraction = turns - ((turns + to_whole) - to_whole);
    // Half a turn times 2^32 does not fit an int32, so half of it is converted and doubled.
    const U half = same_bits<U>(xsimd::to_int(fraction * V(0x1p31f)));
    return half + half;
}

}  // namespace pelagic::kernels
