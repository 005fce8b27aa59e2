// What a transform kernel reads of an FftPlan: plain pointers, no containers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pelagic {

/// One pass: groups of `radix` finished transforms of `span` points become transforms of radix * span points.
struct FftStep {
    int radix;
    int span;
    /// For each j in [0, span): e^{2 pi i l j / (radix span)} for l = 0, ..., radix - 1 as pairs (re, im).
    std::size_t first_twiddle;
};

/// The inputs i = plus + s N/R, s = 0, ..., R - 1, go through the first step (radix R) together, and so do their
/// negatives: N - i stands in the group `minus` at R - 1 - s. Two groups are their own negatives, element by element.
struct GroupPair {
    std::uint16_t plus, minus;
    bool is_own_negative() const { return plus == minus; }
};

struct FftTables {
    int size;
    const FftStep* steps;
    std::size_t step_count;
    const float* twiddles;  ///< of all steps, aligned to 64 bytes
    /// Where input i goes before the first step: the digits of i in the radices, reversed (VR Ocean, 3.6.4). The
    /// inputs of a group stand side by side.
    const std::uint16_t* positions;
    /// Every pair of groups, in the order in which the parts of the last step need them: part l, the inputs i with
    /// remainder l modulo the last radix, comes together with part -l. Those of l are
    /// pairs[first_pair[l]] to pairs[first_pair[l + 1]], for l = 0, ..., radix / 2.
    const GroupPair* pairs;
    const std::uint16_t* first_pair;

    const FftStep& first_step() const { return steps[0]; }
    const FftStep& last_step() const { return steps[step_count - 1]; }
};

}  // namespace pelagic
