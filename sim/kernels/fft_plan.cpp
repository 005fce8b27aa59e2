#include "pelagic/sim/kernels/fft_plan.hpp"

#include <algorithm>
#include <bit>
#include <cassert>

#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

// log2 of each radix, first step first: as many radix 8 steps as possible, the remaining ones of
// radix 4. The radix 4 steps come first, where the data is still in order.
struct Radices {
    std::array<int, 4> bits{};
    std::size_t count = 0;
};

Radices radices_of(int size) {
    const int total_bits = std::bit_width(static_cast<unsigned>(size)) - 1;
    // 2 bits each: a remainder of 1 bit needs two radix 4 steps.
    const int fours = total_bits % 3 == 0 ? 0 : (3 - total_bits % 3);
    Radices radices;
    for (int i = 0; i < fours; ++i) radices.bits[radices.count++] = 2;
    for (int remaining = total_bits - 2 * fours; remaining > 0; remaining -= 3) radices.bits[radices.count++] = 3;
    return radices;
}

}  // namespace

FftPlan::FftPlan(int size) : size_(size) {
    assert(size >= 16 && size <= 2048 && std::has_single_bit(static_cast<unsigned>(size)));
    const DefaultFloatEnvironment environment;
    const Radices radices = radices_of(size);
    int span = 1;
    std::vector<float> roots;
    for (std::size_t step = 0; step < radices.count; ++step) {
        const int radix = 1 << radices.bits[step];
        steps_[step_count_++] = {radix, span, roots.size()};
        for (int j = 0; j < span; ++j) {
            for (int l = 0; l < radix; ++l) {
                const auto root = det::sine_cosine_of_turns(static_cast<double>(l * j) / (radix * span));
                roots.push_back(static_cast<float>(root.cosine));
                roots.push_back(static_cast<float>(root.sine));
            }
        }
        span *= radix;
    }
    twiddles_ = AlignedBuffer<float>(roots.size());
    std::copy(roots.begin(), roots.end(), twiddles_.data());
    place_inputs();
    pair_groups();
}

// The last step combines inputs by their remainder modulo its radix, the step before by the next
// digit, ...
void FftPlan::place_inputs() {
    positions_.resize(static_cast<std::size_t>(size_));
    for (int i = 0; i < size_; ++i) {
        int digits = i;
        int block = size_;
        int position = 0;
        for (std::size_t step = step_count_; step-- > 0;) {
            block /= steps_[step].radix;
            position += digits % steps_[step].radix * block;
            digits /= steps_[step].radix;
        }
        positions_[static_cast<std::size_t>(i)] = static_cast<std::uint16_t>(position);
    }
}

void FftPlan::pair_groups() {
    const int groups = size_ / steps_[0].radix;
    const int blocks = steps_[step_count_ - 1].radix;
    for (int block = 0; block <= blocks / 2; ++block) {
        const bool is_own_negative = block == 0 || block == blocks / 2;
        for (int plus = block; plus < groups; plus += blocks) {
            const int minus = (groups - plus) % groups;
            if (is_own_negative && minus < plus) continue;  // already stored as (minus, plus)
            pairs_.push_back({static_cast<std::uint16_t>(plus), static_cast<std::uint16_t>(minus)});
        }
        first_pair_[static_cast<std::size_t>(block) + 1] = static_cast<std::uint16_t>(pairs_.size());
    }
}

FftTables FftPlan::tables() const {
    return {size_,         steps_.data(),     step_count_, twiddles_.data(), positions_.data(),
            pairs_.data(), first_pair_.data()};
}

std::size_t FftPlan::bytes() const {
    return twiddles_.bytes() + positions_.capacity() * sizeof(std::uint16_t) + pairs_.capacity() * sizeof(GroupPair);
}

}  // namespace pelagic
