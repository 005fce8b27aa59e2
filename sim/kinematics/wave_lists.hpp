// The waves of a cascade as a list, for sums at given points.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/kernels/wave_sum_jobs.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

/// The waves of a line of the half plane that a cascade stores, without those of amplitude 0.
struct LineOfWaves {
    struct Entry {
        std::int32_t m, n;
        std::uint32_t harmonic;  ///< periods in a loop
        double steps;            ///< |k| in units of 2 pi / L
        float packed[4];         ///< S' of packed_spectrum.hpp times 2 / (1 + e^{-2kd})
        float flow_factor;       ///< 2 pi harmonic / T over steps tanh(k d)
        float mirror;            ///< e^{-2kd}, 0 below e^-80
    };
    std::vector<Entry> entries;
};

class CascadeWaves;

/// Computes the waves of line n, in [0, N/2).
LineOfWaves line_of_waves(const SeaState& sea, const CascadeWaves& waves, int n);

/// Waves of a cascade, by wave number.
class WaveList {
   public:
    WaveList(const CascadeGrid& grid, std::span<const LineOfWaves> lines);

    const CascadeGrid& grid() const { return grid_; }
    std::size_t size() const { return size_; }  ///< without padding
    /// Returns the size with the waves of amplitude 0 that fill the last sums of a block.
    std::size_t padded_size() const { return steps_.size(); }

    /// The four numbers of each wave at a moment, which WaveBlock describes.
    struct Moved {
        explicit Moved(const WaveList& list);
        AlignedBuffer<float> head_re, head_im, flow_re, flow_im;
    };
    /// Returns the job that moves all waves. \param fraction  of the loop, in units of 2^-32
    MoveWavesJob move_job(std::uint32_t fraction, Moved& to) const;
    /// Calls use(block) for the blocks of all waves, without those shorter than the footprint. Blocks are valid in the
    /// call.
    template <class Use>
    void for_each_block(const Moved& moved, double footprint_m, Use use) const {
        const std::size_t end = footprint_m > 0 ? waves_from(footprint_m) : padded_size();
        for (std::size_t number = 0; number * WaveBlock::max_count < end; ++number) {
            WaveBlock all = block(moved, number);
            const std::size_t here = std::min(all.count, end - number * WaveBlock::max_count);
            all.count = here / WaveBlock::partial_sums * WaveBlock::partial_sums;
            if (all.count > 0) use(all);
            if (all.count < here) {
                const LastWaves last(all, here);
                use(last.block);
            }
        }
    }

   private:
    WaveBlock block(const Moved& moved, std::size_t number) const;
    /// The waves from all.count to `end`, and then waves of amplitude 0.
    struct LastWaves {
        LastWaves(const WaveBlock& all, std::size_t end);
        LastWaves(const LastWaves&) = delete;  // the block has pointers into it
        alignas(64) float moved[4][WaveBlock::partial_sums] = {};
        WaveBlock block;
    };
    /// Returns the number of waves at least that long.
    std::size_t waves_from(double length_m) const;

    CascadeGrid grid_;
    std::size_t size_;
    std::size_t mirrored_;  ///< waves before the first without a mirror
    AlignedBuffer<std::uint32_t> m_, n_, harmonics_;
    AlignedBuffer<float> steps_, mirror_, flow_factor_, packed_[4];
};

}  // namespace pelagic
