// Elementary functions in double precision with bit-identical results on every machine.
//
// libm's exp, log and sine differ between systems and versions in their last bits, and the spectrum
// is computed from them. These functions use only + - * /, sqrt and integer operations, which are
// exact or correctly rounded by IEEE 754. They are compiled without contraction. Their relative
// error is at most 4e-16 (pow: times |y log x|; tanh: 1e-14). tests/det_math_test.cpp compares them
// with libm in long double.
#pragma once

#include "pelagic/simd/strict_floats.hpp"

namespace pelagic::det {

/// Returns the natural logarithm. \pre x is positive, normal and finite
double log(double x);

/// Returns e^x: 0 below about -708, infinity above 709.78.
double exp(double x);

/// Returns x^y = exp(y log x). \pre x is positive, normal and finite
double pow(double x, double y);

/// Returns the hyperbolic tangent. \pre x is not negative
double tanh(double x);

struct SineCosine {
    double sine, cosine;
};

/// Returns sin(2 pi turns) and cos(2 pi turns). \pre |turns| < 2^50
SineCosine sine_cosine_of_turns(double turns);

}  // namespace pelagic::det
