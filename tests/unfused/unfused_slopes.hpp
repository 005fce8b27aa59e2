// Stages `slopes` and `slopes tail` over a whole cascade, one float at a time, as UnfusedSea has the others.
#pragma once

#include <cstdint>
#include <vector>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/slope_sum.hpp"

namespace pelagic::unfused {

/// What a cascade's slopes are made from: tight rows of N^2, metres.
struct CascadePlanes {
    int resolution;
    double side_m;
    float cosine, sine;  ///< how the cascade is turned
    std::vector<float> dx, height, dz;
    FoamSource foam = {.offset = 200, .scale = 255};
};

struct CascadeSlopes {
    std::vector<std::uint32_t> slopes, moments;  ///< chains
    std::vector<std::uint16_t> halves;
};

CascadeSlopes slopes_of(const CascadePlanes& planes, const SlopeRanges& ranges);

}  // namespace pelagic::unfused
