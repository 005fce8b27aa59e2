// The commands of an events file, by the tick before which they take effect.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "pelagic/tools/events/event_file.hpp"

namespace pelagic::tools {

struct EventCommand {
    std::int64_t tick;
    enum class Kind { remove, push } kind;  ///< within one tick in this order
    std::size_t event;                      ///< its index in the file
};

/// Returns the commands in order. An event acts in the first tick that is not before it, a source
/// until it ends. Throws InputError if more disturbances meet in a tick than DynamicWaves accepts.
std::vector<EventCommand> event_commands(const EventFile& file, int ticks_per_s);

}  // namespace pelagic::tools
