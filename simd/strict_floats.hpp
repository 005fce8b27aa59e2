// Rejects compilation with flags that reorder floating-point arithmetic, which would change results
// without an error. cmake/pelagic_target.cmake disables these flags; this check covers other
// builds.
#pragma once

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__)
#error "-ffast-math and its component flags change Pelagic's results: compile its sources with -fno-fast-math"
#endif
