// The options --sea-level and --current.
#pragma once

#include <CLI/App.hpp>
#include <optional>
#include <string>

#include "pelagic/sim/water_frame.hpp"

namespace pelagic::tools {

class WaterFrameFlags {
   public:
    void add_to(CLI::App& app);
    /// Checks the options.
    /// \param has_shore  whether --shore is given, which excludes both options
    /// \throws InputError  on one line with option, value and range
    WaterFrame resolve(bool has_shore) const;
    /// Returns the options as given on the command line, " --sea-level M --current X,Z".
    std::string typed() const;

   private:
    std::optional<std::string> sea_level_, current_;
};

}  // namespace pelagic::tools
