// Kernels are made of small functions on registers. Left to itself the compiler makes calls of some of them, which
// sends every register through memory. Instrumented for AddressSanitizer it may: inlined, a kernel compiles for minutes.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#define PELAGIC_INLINE inline
#define PELAGIC_INLINE_LAMBDA
#define PELAGIC_FLATTEN inline
#else
#define PELAGIC_INLINE [[gnu::always_inline]] inline
/// The same behind the parameters of a lambda.
#define PELAGIC_INLINE_LAMBDA __attribute__((always_inline))
/// The same from the caller's side, for the loops around them: everything that they call becomes a part of them, xsimd's
/// own functions too, some of which are calls on NEON.
#define PELAGIC_FLATTEN [[gnu::flatten]] inline
#endif
