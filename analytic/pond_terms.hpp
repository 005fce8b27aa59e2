// An octave as the kernel takes it.
#pragma once

#include "pelagic/analytic/pond_waves.hpp"
#include "pelagic/analytic/kernels/analytic_kernels.hpp"

namespace pelagic {

PondTerms pond_terms_of(const PondOctave& octave);

}  // namespace pelagic
