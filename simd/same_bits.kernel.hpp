// Reinterpretation of a register as another type. xsimd 8.1's bitwise_cast is a call on NEON.
#pragma once

#include <xsimd/xsimd.hpp>

#include "pelagic/simd/always_inline.hpp"

namespace pelagic::kernels {

template <class To, class From>
PELAGIC_INLINE To same_bits(From from) {
    using Register = typename To::register_type;
    return To((Register)(from.data));
}

}  // namespace pelagic::kernels
