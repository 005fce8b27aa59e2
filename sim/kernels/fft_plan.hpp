// Plan of a transform of N points: radix 8 and radix 4 steps, the input permutation and the twiddle
// factors.
//
// Decimation in time (Cooley and Tukey 1965; VR Ocean, 3.6) with mixed radices; the paper's radix 2
// needs three times as many passes over the data. The kernel is e^{+2 pi i/N} without the factor
// 1/N; the paper prints the other sign (errata).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "pelagic/sim/kernels/fft_tables.hpp"
#include "pelagic/simd/aligned_buffer.hpp"

namespace pelagic {

/// The plan of one transform size.
class FftPlan {
   public:
    /// \param size  a power of two from 16 to 2048
    explicit FftPlan(int size);

    /// Returns pointers into the plan, valid during its lifetime.
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
