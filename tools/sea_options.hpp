// [sea] of the command line: presets, a config file and flags, in this order of precedence, become a SeaState.
#pragma once

#include <CLI/App.hpp>
#include <map>
#include <optional>
#include <string>

#include "pelagic/sim/sea_state.hpp"

namespace pelagic::tools {

/// A sea as resolved; the direction is kept in degrees as typed, so that files show the same number.
struct ResolvedSea {
    SeaState sea;
    double wind_direction_deg = 0;
    std::string preset;  ///< empty if none was named
};

class SeaOptions {
   public:
    /// Declares --preset, --config, --spectrum and a flag for each numeric field, with units, ranges and defaults.
    void add_to(CLI::App& app);

    /// Defaults < preset < config file < flags. Throws InputError, one line that names option, value and range.
    ResolvedSea resolve() const;

   private:
    std::map<std::string, std::optional<std::string>> typed_;  ///< by flag name, where it was given
};

}  // namespace pelagic::tools
