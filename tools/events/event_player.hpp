// Dynamic waves the rows of a file, at any times: the same bits for a time whichever others were asked for before.
//
// Ticks follow upon each other from the one before the first event on, so a time costs the ticks since the time asked for before,
// or since the first event if that was later. An event counts in the first tick that is not before it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/events/event_commands.hpp"
#include "pelagic/tools/events/event_options.hpp"

namespace pelagic::tools {

class EventPlayer {
   public:
    /// Throws what event_commands() throws.
    EventPlayer(const EventOptions& options, std::shared_ptr<Executor> executor, std::optional<Isa> isa);

    /// Valid until it is called again. \pre time_s is finite
    DynamicWavesView at(double time_s);

   private:
    void run_command(const EventCommand& command);
    void go_to(std::int64_t tick);
    double time_of(std::int64_t tick) const { return static_cast<double>(tick) / rate_; }

    EventOptions options_;
    double rate_;
    std::vector<EventCommand> commands_;
    std::size_t next_command_ = 0;
    std::vector<std::uint32_t> numbers_;  ///< of each event's source
    std::int64_t first_tick_ = 0, tick_ = 0;
    Ocean ocean_;
    std::vector<std::uint8_t> beginning_;
};

/// The frame with the water beside its cascades, within its bounds.
Frame with_water(const Frame& frame, const DynamicWavesView& water);

}  // namespace pelagic::tools
