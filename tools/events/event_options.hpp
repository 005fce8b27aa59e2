// Which pushes at the water a command was given, and the grid that answers them.
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
#include "pelagic/tools/text/named_values.hpp"

namespace pelagic::tools {

inline constexpr NamedValues<DynamicWavesStep, 2> dynamic_waves_step_names = {
    {{DynamicWavesStep::spectral, "spectral"}, {DynamicWavesStep::verlet, "verlet"}}};

struct EventOptions {
    std::shared_ptr<const EventFile> file;
    DynamicWavesOptions water;
    double middle_x_m = 0, middle_z_m = 0;  ///< of the grid, which rests

    double texel_m() const { return water.side_m / water.resolution; }
    /// The lowest texels of the grid, along x and z; texel i stands at i texel_m().
    std::array<std::int64_t, 2> first_texels() const;
    /// Rows whose push begins outside of the grid, where no water answers.
    std::size_t events_outside() const;
};

/// What people should know of them: "3 of 10 events begin outside of the grid ...". \param is_loop  frames are one loop
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
