// Kernels are made of small functions on registers. Left to itself the compiler makes calls of some of them, which
// sends every register through memory.
#pragma once

#define PELAGIC_INLINE [[gnu::always_inline]] inline
/// The same behind the parameters of a lambda.
#define PELAGIC_INLINE_LAMBDA __attribute__((always_inline))
