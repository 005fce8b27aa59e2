// What one core of this machine can do at best, to hold the stages against.
#pragma once

#include <cstddef>

#include "pelagic/simd/isa.hpp"

namespace pelagic::bench {

/// Adds and multiplies, as many of one as of the other and none waiting for another: the most that a kernel without
/// fused operations can get. Runs `rounds` rounds and returns how many floating-point operations that were.
double run_arithmetic(Isa isa, std::size_t rounds);

/// Copies `floats` floats `rounds` times and returns how many bytes were read and written.
double run_copy(Isa isa, const float* from, float* to, std::size_t floats, std::size_t rounds);

}  // namespace pelagic::bench
