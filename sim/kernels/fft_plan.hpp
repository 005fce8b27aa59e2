// How a transform of N points is cut: radix 8 and 4 steps, where each input goes, and the twiddle factors.
//
// Decimation in time (Cooley and Tukey 1965; VR Ocean, 3.6) with mixed radices, the paper's radix 2 costs three times
// the passes over the data. Kernel e^{+2 pi i/N}, no 1/N: the paper prints the other sign (errata).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/sim/kernels/fft_tables.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

/// The plan of one size; tables() points into it.
class FftPlan {
   public:
    /// \param size  a power of two from 16 to 2048
    explicit FftPlan(int size);

    FftTables tables() const;
    std::span<const GroupPair> pairs() const { return pairs_; }
    std::size_t bytes() const;

   private:
    void place_inputs();
    void pair_groups();

    int size_;
    std::size_t step_count_ = 0;
    std::array<FftStep, 4> steps_{};
    AlignedBuffer<float> twiddles_;
    std::vector<std::uint16_t> positions_;
    std::vector<GroupPair> pairs_;
    std::array<std::uint16_t, 6> first_pair_{};
};

}  // namespace pelagic
