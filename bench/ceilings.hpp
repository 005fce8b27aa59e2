// Upper bounds of one core's throughput, for comparison with stages.
#pragma once

#include <cstddef>

#include "pelagic/simd/isa.hpp"

namespace pelagic::bench {

/// Runs `rounds` rounds of independent additions and multiplications in equal numbers, the maximum
/// throughput of a kernel without fused operations. Returns the number of floating-point
/// operations.
double run_arithmetic(Isa isa, std::size_t rounds);

/// Copies `floats` floats `rounds` times. Returns the number of bytes read and written.
double run_copy(Isa isa, const float* from, float* to, std::size_t floats, std::size_t rounds);

}  // namespace pelagic::bench
