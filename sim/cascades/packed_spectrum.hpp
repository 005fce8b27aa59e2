// Stage `spectrum`: computes the waves at t = 0 and packs them so that one rotation evolves a wave
// to time t (VR Ocean, 3.2.5 to 3.4.3).
//
// With h0(k) = a + ib and conj(h0(-k)) = c + id, equation 22 packs
//   S' = (a + c, b + d, b - d, c - a),  and
//   h(k, t) = S'_xy cos(phase) + S'_zw sin(phase) = h0(k) e^{-i phase} + conj(h0(-k)) e^{+i phase}.
// Only kz in [0, N/2) is stored. Heights are real, so the other half plane is its mirror image.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pelagic/sim/kernels/fft_plan.hpp"
#include "pelagic/sim/kernels/wave_blocks.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/spectrum/amplitudes.hpp"
#include "pelagic/sim/spectrum/mean_square_slope.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

/// Packed half plane, in the order in which the first transform reads it: for each of plan.pairs(),
/// one pair of waves for each input of the group `plus`. A group that is its own negative holds
/// every wave as a `plus`, and the pair's `minus` is zero.
struct PackedSpectrum {
    /// \param lanes  SIMD lanes of the instruction set that reads the spectrum (Kernels::lanes)
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
    std::size_t pairs;                       ///< pairs of waves in one block of lines
    AlignedBuffer<float> waves;              ///< [line block][pair][WaveQuantity][lane]
    AlignedBuffer<std::uint32_t> harmonics;  ///< [line block][pair][lane], periods in a loop
};

/// Contribution of a line's waves, and of its mirror's, to the statistics of the sea. All except
/// those of the trace and the level are means over all seeds.
struct LineStatistics {
    double height_variance = 0;    ///< m^2
    double mean_square_slope = 0;  ///< h_x^2 + h_z^2 of the waves, not of the textures
    /// (Dx,x + Dz,z)^2 of the waves, not of the textures, at choppiness 1.
    double mean_square_convergence = 0;
    SlopeMoments slopes;  ///< of the cascade's textures, along the axes of the cascade
    /// Mean square of the compression at choppiness 1, -(Dx,x + Dz,z) - foam_front() . grad h, and of
    /// its rate of change in 1/s at drifting foam: of the waves of this sea's seed, as bilinear
    /// filtering between the texels of compression shows them, in the mean over all positions.
    double compression_square = 0, compression_rate_square = 0;
    /// Covariance of -(Dx,x + Dz,z) with that compression, and with its quadrature: that of a
    /// quarter of each wave's period before.
    double contraction = 0, contraction_before = 0;
    /// compression_square on columns of texels less that midway between two columns, and of rows.
    double compression_drop_x = 0, compression_drop_z = 0;
    /// Sum of cos b k coth(k d) a^2 / 2 over the waves of this sea's seed, with orbit_ratio() and the
    /// angle b of the lean, m.
    double level_m = 0;
    /// Stokes drift at the surface along the axes of the cascade, m/s.
    double stokes_x = 0, stokes_z = 0;
    /// Of it, what water lacks that follows velocities of WaterLevels: half, because velocities follow the
    /// surface upwards, and choppiness / 2, because they are those of displaced points; nothing of waves that
    /// have no velocity. The sum of its sizes, and of these times k, 1/s.
    double lacking_x = 0, lacking_z = 0, lacking_size = 0, lacking_k = 0;

    LineStatistics& operator+=(const LineStatistics& other);
};

/// LineStatistics for each frequency band (harmonic_band()).
class StatisticsByBand {
   public:
    /// Returns a band's statistics; adds the band if it is missing.
    LineStatistics& operator[](std::size_t band);
    StatisticsByBand& operator+=(const StatisticsByBand& other);

    std::size_t first() const { return first_; }
    std::size_t end() const { return first_ + statistics_.size(); }
    /// Returns a band's statistics, or zeros if it is missing.
    LineStatistics at(std::size_t band) const {
        return band < first() || band >= end() ? LineStatistics() : statistics_[band - first_];
    }

    std::size_t bytes() const { return statistics_.capacity() * sizeof(LineStatistics); }

   private:
    std::size_t first_ = 0;
    std::vector<LineStatistics> statistics_;
};

/// Returns the statistics during a sea-state transition: linear blends, because each is a sum over
/// energies. The result is bit-identical to `before` for weight 0 and to `after` for weight 1.
/// \param weight  of `after`, in [0, 1]
LineStatistics between(const LineStatistics& before, const LineStatistics& after, double weight);

/// Fills one line and returns its statistics. Lines are independent and may be baked in parallel.
/// \param line     in [0, line_count())
/// \param by_band  receives the line's statistics by frequency band; may be null
LineStatistics bake_spectrum_line(const SeaState& sea, const CascadeWaves& waves, const FftPlan& plan,
                                  std::size_t line, PackedSpectrum& out, StatisticsByBand* by_band = nullptr);

}  // namespace pelagic
