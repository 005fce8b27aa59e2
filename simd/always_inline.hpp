// Forced inlining of the small register functions of kernels. A call passes every register through
// memory. AddressSanitizer builds do not force inlining, because a kernel would compile for
// minutes.
#pragma once

#if defined(__SANITIZE_ADDRESS__)
#define PELAGIC_INLINE inline
#define PELAGIC_INLINE_LAMBDA
#define PELAGIC_FLATTEN inline
#else
#define PELAGIC_INLINE [[gnu::always_inline]] inline
/// PELAGIC_INLINE for lambdas; stands after the parameters.
#define PELAGIC_INLINE_LAMBDA __attribute__((always_inline))
/// Inlines every function that the marked function calls, for the loops of kernels. Includes
/// xsimd's functions, some of which are calls on NEON.
#define PELAGIC_FLATTEN [[gnu::flatten]] inline
#endif

/// PELAGIC_INLINE for large functions with several callers. WebAssembly calls them: a module is a
/// sixth smaller, and queries take no longer.
#if defined(__wasm__)
#define PELAGIC_INLINE_LARGE [[gnu::noinline]]
#else
#define PELAGIC_INLINE_LARGE PELAGIC_INLINE
#endif
