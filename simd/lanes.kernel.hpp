// Selection of a function's version by instruction set.
//
// The lane count of Arch selects a version, never the compiler's target macros: an application
// built with -march=native compiles the SSE4.2 kernels with AVX-512 enabled. A macro around a
// version only guards that the compiler accepts its intrinsics.
#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

namespace pelagic::kernels {

/// True if a register of Arch holds `count` floats: 4 for SSE4.2, NEON and WebAssembly, 8 for AVX2,
/// 16 for AVX-512.
template <class Arch, std::size_t count>
concept HasLanes = xsimd::batch<float, Arch>::size == count;

}  // namespace pelagic::kernels
