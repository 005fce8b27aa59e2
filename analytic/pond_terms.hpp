// Conversion of an octave to the kernel's constants.
#pragma once

#include "pelagic/analytic/kernels/analytic_kernels.hpp"
#include "pelagic/analytic/pond_waves.hpp"

namespace pelagic {

PondTerms pond_terms_of(const PondOctave& octave);

}  // namespace pelagic
