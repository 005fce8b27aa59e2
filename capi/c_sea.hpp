// Conversion of pelagic_sea.
#pragma once

#include "pelagic/pelagic.h"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic::capi {

/// Converts a sea. Throws std::invalid_argument for null and a wrong struct_size. check() checks
/// the values.
SeaState sea_of(const pelagic_sea* sea);

/// Converts a wave system. Throws std::invalid_argument for unknown models.
/// \param prefix  of its names in messages: "systems[0]."
WaveSystem wave_system_of(const pelagic_wave_system& from, std::string_view prefix);

/// Writes a sea. Throws std::invalid_argument for null and a wrong struct_size.
void write_sea(const SeaState& from, pelagic_sea* sea);

}  // namespace pelagic::capi
