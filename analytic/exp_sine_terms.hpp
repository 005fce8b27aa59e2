// An octave as the kernel takes it.
#pragma once

#include "pelagic/analytic/exp_sine_water.hpp"
#include "pelagic/analytic/kernels/analytic_kernels.hpp"

namespace pelagic {

ExpSineTerms exp_sine_terms_of(const ExpSineOctave& octave);

}  // namespace pelagic
