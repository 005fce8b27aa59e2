// Four floats that all instruction sets add and multiply at once, with equal bits. For short sums
// outside kernels, which are compiled once for all instruction sets.
#pragma once

#include <cstring>

namespace pelagic {

/// A vector extension of GCC and Clang.
using FourFloats = float __attribute__((vector_size(16)));

/// Loads four floats at any address.
inline FourFloats four_floats_at(const float* from) {
    FourFloats values;
    std::memcpy(&values, from, sizeof values);
    return values;
}

inline FourFloats four_times(float value) { return FourFloats{value, value, value, value}; }

}  // namespace pelagic
