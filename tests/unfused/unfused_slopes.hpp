// The stages `slopes` and `slopes tail` over a whole cascade, one float at a time, like the other
// stages in UnfusedSea.
#pragma once

#include <cstdint>
#include <vector>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/slope_sum.hpp"

namespace pelagic::unfused {

/// Inputs of a cascade's slopes: tight rows of N^2 values, in m.
struct CascadePlanes {
    int resolution;
    double side_m;
    float cosine, sine;  ///< rotation of the cascade
    std::vector<float> dx, height, dz;
};

struct CascadeSlopes {
    std::vector<std::uint32_t> slopes, moments;  ///< mip chains
    std::vector<std::uint16_t> halves;
};

CascadeSlopes slopes_of(const CascadePlanes& planes, const SlopeRanges& ranges);

}  // namespace pelagic::unfused
