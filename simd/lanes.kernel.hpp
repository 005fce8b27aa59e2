// Which of several versions of a piece an instruction set takes.
//
// By the lanes of Arch, never by what the compiler may use: an application that builds everything with -march=native compiles the
// SSE4.2 kernels too with AVX-512 switched on. The macros around a version only say that its instructions can be named.
#pragma once

#include <cstddef>
#include <xsimd/xsimd.hpp>

namespace pelagic::kernels {

/// A register of Arch holds `count` floats: 4 for SSE4.2, NEON and WebAssembly, 8 for AVX2, 16 for AVX-512.
template <class Arch, std::size_t count>
concept HasLanes = xsimd::batch<float, Arch>::size == count;

}  // namespace pelagic::kernels
