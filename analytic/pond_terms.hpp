// An octave as the kernel takes it.
#pragma once

#include "pelagic/analytic/kernels/analytic_kernels.hpp"
#include "pelagic/analytic/pond_waves.hpp"

namespace pelagic {

PondTerms pond_terms_of(const PondOctave& octave);

}  // namespace pelagic
