// Elementary functions in double that give the same bits on every machine.
//
// libm's exp, log and sine differ between systems and versions in their last bits, and the spectrum is baked from
// them. These use only + - * /, sqrt and integer operations, all exact or correctly rounded by IEEE 754, and are
// compiled without contraction. They are within 4e-16 relative of the truth (pow: times the size of y log x; tanh: 1e-14),
// which tests/det_math_test.cpp checks against libm in long double.
#pragma once

#include "pelagic/simd/strict_floats.hpp"

namespace pelagic::det {

/// Natural logarithm. \pre x is positive, normal and finite
double log(double x);

/// e^x; 0 below about -708, infinity above 709.78.
double exp(double x);

/// x^y = exp(y log x). \pre x is positive, normal and finite
double pow(double x, double y);

/// Hyperbolic tangent. \pre x is not negative
double tanh(double x);

struct SineCosine {
    double sine, cosine;
};

/// sin and cos of 2 pi turns. \pre |turns| < 2^50
SineCosine sine_cosine_of_turns(double turns);

}  // namespace pelagic::det
