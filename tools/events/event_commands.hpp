// What is said to the water before which tick.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pelagic/tools/events/event_file.hpp"

namespace pelagic::tools {

struct EventCommand {
    std::int64_t tick;
    enum class Kind { remove, push } kind;  ///< of one tick in this order
    std::size_t event;                      ///< in the file's order
};

/// In their order: an event counts in the first tick that is not before it, and while it lasts. Throws InputError if more pushes
/// meet in a tick than an ocean takes.
std::vector<EventCommand> event_commands(const EventFile& file, int ticks_per_s);

}  // namespace pelagic::tools
