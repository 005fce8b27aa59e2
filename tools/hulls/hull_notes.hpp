// What `query --hull` prints about a hull in a sea before its motion.
#pragma once

#include <string>
#include <vector>

#include "pelagic/floating/hull.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic::tools {

/// Returns the natural periods and the length over the peak wavelength, and a line for each limit of
/// docs/floating.md that the hull exceeds in waves of the peak. \pre the hull floats
std::vector<std::string> notes_on(const Hull& hull, const SeaState& sea);

}  // namespace pelagic::tools
