// The events that a command was given, and the grid of their dynamic waves.
#pragma once

#include <CLI/App.hpp>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/tools/events/event_file.hpp"

namespace pelagic::tools {

struct EventOptions {
    std::shared_ptr<const EventFile> file;
    DynamicWavesOptions water;
    double middle_x_m = 0, middle_z_m = 0;  ///< centre of the grid
    bool follows_hull = false;              ///< a hull moves the centre

    double texel_m() const { return water.side_m / water.resolution; }
    /// Returns the lowest texels of the grid along x and z; texel i is at i texel_m().
    std::array<std::int64_t, 2> first_texels() const;
    /// Returns the number of events that begin outside of the grid, where they have no effect.
    std::size_t events_outside() const;
};

/// A hull around which the grid lies, unless options place it.
struct HullPlace {
    double length_m = 1, x_m = 0, z_m = 0;
};

/// Returns warnings, such as "3 of 10 events begin outside of the grid ...".
/// \param is_loop  the frames are one loop
std::vector<std::string> warnings_about(const EventOptions& options, bool is_loop);

/// Throws InputError if ticks from the first event, if there is one, to the last frame would take
/// days.
void require_reachable(const EventOptions& options, double last_frame_s);

class EventFlags {
   public:
    void add_to(CLI::App& app);
    /// Returns none without --events and without a hull. Throws InputError.
    /// \param depth_m  depth of the (first) sea, which dynamic waves share
    /// \param hull     none: no hull makes waves
    std::optional<EventOptions> resolve(double depth_m, const std::optional<HullPlace>& hull = {}) const;

   private:
    std::optional<std::string> file_, side_, resolution_, at_, step_;
};

}  // namespace pelagic::tools
