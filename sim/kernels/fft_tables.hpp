// The data of an FftPlan that transform kernels read: plain pointers, no containers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pelagic {

/// One pass: combines groups of `radix` transforms of `span` points into transforms of radix * span
/// points.
struct FftStep {
    int radix;
    int span;
    /// For each j in [0, span): e^{2 pi i l j / (radix span)} for l = 0, ..., radix - 1 as pairs
    /// (re, im).
    std::size_t first_twiddle;
};

/// A pair of input groups of the first step (radix R). The group `plus` has the inputs
/// i = plus + s N/R, s = 0, ..., R - 1. Their negatives N - i are the group `minus`, in which N - i
/// has index R - 1 - s. Two groups are their own negatives, element by element.
struct GroupPair {
    std::uint16_t plus, minus;
    bool is_own_negative() const { return plus == minus; }
};

struct FftTables {
    int size;
    const FftStep* steps;
    std::size_t step_count;
    const float* twiddles;  ///< twiddle factors of all steps, aligned to 64 bytes
    /// Position of input i before the first step: the digits of i in the radices, reversed (VR
    /// Ocean, 3.6.4). The inputs of a group are contiguous.
    const std::uint16_t* positions;
    /// All pairs of groups, in the order of the last step's subtransforms. Subtransform l has the
    /// inputs i with remainder l modulo the last radix, and is computed together with subtransform
    /// -l. The pairs of l are pairs[first_pair[l]] up to but excluding pairs[first_pair[l + 1]],
    /// for l = 0, ..., radix / 2.
    const GroupPair* pairs;
    const std::uint16_t* first_pair;

    const FftStep& first_step() const { return steps[0]; }
    const FftStep& last_step() const { return steps[step_count - 1]; }
};

}  // namespace pelagic
