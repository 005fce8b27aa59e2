// Which pushes at the water a command was given, and the window that answers them.
#pragma once

#include <CLI/App.hpp>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/sim/local_water.hpp"
#include "pelagic/tools/events/event_file.hpp"
#include "pelagic/tools/text/named_values.hpp"

namespace pelagic::tools {

inline constexpr NamedValues<LocalStep, 2> local_step_names = {
    {{LocalStep::spectral, "spectral"}, {LocalStep::verlet, "verlet"}}};

struct EventOptions {
    std::shared_ptr<const EventFile> file;
    LocalWaterOptions water;
    double middle_x_m = 0, middle_z_m = 0;  ///< of the window, which rests

    double texel_m() const { return water.side_m / water.resolution; }
    /// The lowest texels of the window, along x and z; texel i stands at i texel_m().
    std::array<std::int64_t, 2> first_texels() const;
    /// Rows whose push begins outside of the window, where no water answers.
    std::size_t events_outside() const;
};

/// What people should know of them: "3 of 10 events begin outside of the window ...". \param is_loop  frames are one loop
std::vector<std::string> warnings_about(const EventOptions& options, bool is_loop);

/// Throws InputError if ticks from the first event to the last frame would take days.
void require_reachable(const EventOptions& options, double last_frame_s);

class EventFlags {
   public:
    void add_to(CLI::App& app);
    /// None without --events. Throws InputError.
    /// \param depth_m  of the sea, whose waves of pushes feel it as well; that of its beginning if it changes
    std::optional<EventOptions> resolve(double depth_m) const;

   private:
    std::optional<std::string> file_, side_, resolution_, at_, step_;
};

}  // namespace pelagic::tools
