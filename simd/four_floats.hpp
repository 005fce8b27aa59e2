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

/// Loads four floats at a multiple of 16 bytes.
inline FourFloats four_aligned_floats_at(const float* from) {
    return four_floats_at(static_cast<const float*>(__builtin_assume_aligned(from, 16)));
}

inline FourFloats four_times(float value) { return FourFloats{value, value, value, value}; }

}  // namespace pelagic
