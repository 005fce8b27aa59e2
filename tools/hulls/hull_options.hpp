// The options of a floating hull: --hull, --mass and --hull-*.
#pragma once

#include <CLI/App.hpp>
#include <memory>
#include <optional>
#include <string>

#include "pelagic/floating/hull.hpp"
#include "pelagic/tools/events/event_options.hpp"

namespace pelagic::tools {

/// A hull, and where it is launched.
struct HullLaunch {
    std::shared_ptr<const Hull> hull;
    double x_m = 0, z_m = 0;  ///< of the centre of mass
    double heading_rad = 0;   ///< from +x (east) towards +z (south)
    double thrust_n = 0;      ///< at the centre of mass, towards the bow
    std::string typed = {};   ///< options of its mass and force, for messages

    HullPlace place() const { return {hull->mesh().upper_m().x - hull->mesh().lower_m().x, x_m, z_m}; }
};

/// Throws InputError if the steps from the first time to the last would take days.
void require_reachable(double first_s, double last_s);

class HullFlags {
   public:
    void add_to(CLI::App& app);
    bool has_hull() const { return file_.has_value(); }
    /// Reads the hull. Returns none without --hull.
    /// \throws InputError  for an invalid option or file, and for a hull that sinks
    std::optional<HullLaunch> resolve() const;

   private:
    std::optional<std::string> file_, mass_, position_, heading_, center_, thrust_, coefficients_;
};

}  // namespace pelagic::tools
