// Functions of det_math.hpp for several values together, bit-identical. The terms of a series wait
// for each other, and those of several values do not.
#pragma once

#include <array>
#include <cstddef>

#include "pelagic/simd/strict_floats.hpp"

namespace pelagic::det {

inline constexpr std::size_t batch_size = 8;

/// Replaces each value by tanh() of it. \pre no value is negative
void tanh(std::array<double, batch_size>& values);

}  // namespace pelagic::det
