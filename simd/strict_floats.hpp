// No file whose arithmetic reaches a frame may be compiled with licence to rearrange it: the sea would be another one, and
// nobody would be told. cmake/pelagic_target.cmake switches such flags off; this is for builds that don't use it.
#pragma once

#if defined(__FAST_MATH__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__) || \
    defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || defined(__NO_SIGNED_ZEROS__)
#error "Pelagic promises bits, which -ffast-math and its parts change: compile its sources with -fno-fast-math"
#endif
