// Stage `spectrum`: the waves at t = 0, packed so that moving them in time is one rotation (VR Ocean, 3.2.5 to 3.4.3).
//
// With h0(k) = a + ib and conj(h0(-k)) = c + id, equation 22 packs S' = (a + c, b + d, b - d, c - a), and
//   h(k, t) = S'_xy cos(phase) + S'_zw sin(phase) = h0(k) e^{-i phase} + conj(h0(-k)) e^{+i phase}.
// Only kz in [0, N/2) is kept: the other half plane is its mirror, because the sea is real.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pelagic/sim/foam/whitecaps.hpp"
#include "pelagic/sim/kernels/fft_plan.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/spectrum/amplitudes.hpp"
#include "pelagic/sim/spectrum/mean_square_slope.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

/// The packed half plane, in the order in which the first transform takes it: for each of plan.pairs(), one pair of
/// waves for each input of the group `plus`. Groups that are their own negatives hold every wave as a `plus`; a pair's
/// `minus` is then zero.
struct PackedSpectrum {
    /// \param lanes  of the instruction set that reads it, Kernels::lanes
    PackedSpectrum(const FftPlan& plan, std::size_t lanes, const Allocator& memory = {});

    std::size_t block_floats() const { return pairs * wave_quantities * lanes; }
    float* block(std::size_t line_block) { return waves.data() + line_block * block_floats(); }
    const float* block(std::size_t line_block) const { return const_cast<PackedSpectrum*>(this)->block(line_block); }
    std::uint32_t* block_harmonics(std::size_t line_block) { return harmonics.data() + line_block * pairs * lanes; }
    const std::uint32_t* block_harmonics(std::size_t line_block) const {
        return const_cast<PackedSpectrum*>(this)->block_harmonics(line_block);
    }
    std::size_t bytes() const { return waves.bytes() + harmonics.bytes(); }

    std::size_t lanes;
    std::size_t pairs;                       ///< of waves in one block of lines
    AlignedBuffer<float> waves;              ///< [line block][pair][WaveQuantity][lane]
    AlignedBuffer<std::uint32_t> harmonics;  ///< [line block][pair][lane], periods in one loop
};

/// What the waves of a line and of its mirror add to the sea.
struct LineStatistics {
    double height_variance = 0;    ///< m^2, the mean over all seeds
    double mean_square_slope = 0;  ///< h_x^2 + h_z^2 of the waves themselves, the mean over all seeds
    double mean_square_convergence =
        0;                ///< (Dx,x + Dz,z)^2 of the waves themselves at choppiness 1, the mean over all seeds
    SlopeMoments slopes;  ///< as the cascade shows them, the mean over all seeds, along the cascade's own axes
    FoldMoments folding;  ///< of the waves that this seed drew
    double stokes_x = 0,
           stokes_z = 0;  ///< Stokes' drift at the surface along the cascade's own axes, m/s, the mean over all seeds

    LineStatistics& operator+=(const LineStatistics& other);
};

/// The same by bands of frequency (harmonic_band()).
class StatisticsByBand {
   public:
    /// Room for a band is made.
    LineStatistics& operator[](std::size_t band);
    StatisticsByBand& operator+=(const StatisticsByBand& other);

    std::size_t first() const { return first_; }
    std::size_t end() const { return first_ + statistics_.size(); }
    /// None where there is nothing.
    LineStatistics at(std::size_t band) const {
        return band < first() || band >= end() ? LineStatistics() : statistics_[band - first_];
    }

    std::size_t bytes() const { return statistics_.capacity() * sizeof(LineStatistics); }

   private:
    std::size_t first_ = 0;
    std::vector<LineStatistics> statistics_;
};

/// What they are while one sea turns into another: all are sums over energies. The one or the other, bit for bit, where `part`
/// is 0 or 1.
LineStatistics between(const LineStatistics& before, const LineStatistics& after, double part);

/// Fills one line, 0 <= line < line_count(). Lines are independent. \param by_band  gets the same figures, if there is one
LineStatistics bake_spectrum_line(const SeaState& sea, const CascadeWaves& waves, const FftPlan& plan,
                                  std::size_t line, PackedSpectrum& out, StatisticsByBand* by_band = nullptr);

}  // namespace pelagic
