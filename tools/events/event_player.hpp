// The dynamic waves of an events file, at any times: results depend only on the time, not on
// earlier calls.
//
// Ticks are computed in sequence from the tick before the first event, so the cost of a call is
// that of the ticks since the previous time, or since the first event if that was later. An event
// acts in the first tick that is not before it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "pelagic/floating/hull_plan.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/water_frame.hpp"
#include "pelagic/tools/events/event_file.hpp"
#include "pelagic/tools/events/event_options.hpp"

namespace pelagic::tools {

struct EventCommand {
    std::int64_t tick;
    enum class Kind { remove, push } kind;  ///< within one tick in this order
    std::size_t event;                      ///< its index in the file
};

/// Returns the commands in order. An event acts in the first tick that is not before it, a source
/// until it ends. Throws InputError if more disturbances meet in a tick than DynamicWaves accepts.
std::vector<EventCommand> event_commands(const EventFile& file, int ticks_per_s);

class EventPlayer {
   public:
    /// Throws what event_commands() throws.
    /// \param water  with the current. Events and the grid's centre have positions in the world.
    /// \param begins_s  time from which ticks are computed, if that is before the first event;
    ///                  needed without events
    EventPlayer(const EventOptions& options, std::shared_ptr<Executor> executor, std::optional<Isa> isa,
                const WaterFrame& water = {}, std::optional<double> begins_s = {});

    /// Returns the waves at a time, valid until the second call from now. \pre time_s is finite
    DynamicWavesView at(double time_s);

    /// Calls `show` with the time of each tick, or of some, from the beginning on.
    void report_to(std::function<void(double time_s)> show) { show_ = std::move(show); }
    /// Returns the time of the tick before the first one that is computed.
    double begins_s() const { return time_of(first_tick_); }

    /// Returns the waves, for sources of a hull. They are lost when at() goes back in time.
    DynamicWaves& waves() { return waves_; }
    /// Moves the grid's centre to a hull, unless the options place it.
    void follow_hull(double x_m, double z_m);

   private:
    void run_command(const EventCommand& command);
    void go_to(std::int64_t tick);
    void center_grid() { waves_.set_center(options_.middle_x_m, options_.middle_z_m); }
    double time_of(std::int64_t tick) const { return static_cast<double>(tick) / options_.water.ticks_per_s; }

    EventOptions options_;
    std::vector<EventCommand> commands_;
    std::size_t next_command_ = 0;
    std::vector<std::uint32_t> numbers_;  ///< of each event's source
    std::map<const HullMesh*, HullPlan> plans_;
    std::int64_t first_tick_ = 0, tick_ = 0;
    DynamicWaves waves_;
    bool has_current_;
    std::vector<std::uint8_t> beginning_;
    std::function<void(double)> show_;
};

/// Returns the frame with the dynamic waves beside its cascades, and within its bounds.
Frame with_water(const Frame& frame, const DynamicWavesView& water);

}  // namespace pelagic::tools
