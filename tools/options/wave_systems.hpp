// The wave systems of a sea: on the command line "height=1.2 period=12 from=W spread=15", in a TOML
// file tables [[system]], and in a sea.json objects.
#pragma once

#include <string>
#include <vector>

#include "pelagic/sim/sea_state.hpp"
#include "pelagic/tools/options/config_file.hpp"

namespace pelagic::tools {

/// Returns the systems of --system, one for each text.
/// \throws InputError  for unknown keys, those given twice, values out of range, and too many
std::vector<WaveSystem> parse_wave_systems(const std::vector<std::string>& texts);

/// Returns the systems of an entry of a file. \throws InputError  as parse_wave_systems()
std::vector<WaveSystem> wave_systems_of(const ConfigEntry& entry);

/// Returns the help text of --system.
std::string help_of_system();

/// Returns a text of parse_wave_systems(), without options that have their defaults.
std::string text_of(const WaveSystem& system);

}  // namespace pelagic::tools
