// The motion of a hull as rows: CSV, or JSON with the same names.
#pragma once

#include <string>

#include "pelagic/tools/hulls/hull_player.hpp"

namespace pelagic::tools {

/// Returns "time,x,y,z,...", the names of hull_row()'s values.
std::string hull_columns();

/// Returns a row without its line break: metres, degrees, m/s and m^3, of nine digits.
/// \param as_json  an object instead of values and commas
std::string hull_row(double time_s, const HullMoment& moment, bool as_json);

}  // namespace pelagic::tools
