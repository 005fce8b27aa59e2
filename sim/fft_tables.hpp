// What a transform kernel reads of an FftPlan: plain pointers, no containers.
#pragma once

#include <cstddef>
#include <cstdint>

namespace pelagic {

/// One pass: groups of `radix` finished transforms of `span` points become transforms of radix * span points.
struct FftStep {
    int radix;
    int span;
    /// For each j in [0, span): e^{2 pi i l j / (radix span)} for l = 1, ..., radix - 1 as pairs (re, im).
    std::size_t first_twiddle;
};

struct FftTables {
    int size;
    const FftStep* steps;
    std::size_t step_count;
    const float* twiddles;
    /// Where input i goes before the first step: the digits of i in the radices, reversed (VR Ocean, 3.6.4).
    const std::uint16_t* positions;
};

}  // namespace pelagic
