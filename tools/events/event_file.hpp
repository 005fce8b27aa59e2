// Pushes at the water as people keep them: a CSV file whose first line names its columns, a row for each push.
//
//   time, x, z         seconds, metres: when and where in the world; needed
//   radius, strength   metres: how wide, how high the water is pushed (below 0: down); needed
//   velocity, heading  metres a second, and degrees from east (+x) towards south (+z): how the push moves while it lasts
//   duration           seconds that it lasts; 0, as without it: it is one push
//   length             metres: half a hull's length, whose half beam is the radius; 0, as without it: it is round
//   mode               impulse, pressure or relaxation (sim/disturbance.hpp); impulse for one push, pressure for what lasts, unless it says so
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/sim/disturbance.hpp"

namespace pelagic::tools {

struct WaterEvent {
    double time_s = 0, duration_s = 0;
    Disturbance push;  ///< where it is at that time, and how it moves
};

struct EventFile {
    static constexpr std::size_t max_bytes = std::size_t{16} << 20, max_events = 100'000;
    static constexpr double longest_s = 86400;  ///< of an event

    std::string text;                ///< as it was read
    std::string digest;              ///< of it
    std::vector<WaterEvent> events;  ///< at least one, in the order of the rows

    double first_s() const;
};

/// Throws InputError, one line that names the file, the row's line, the column, its value and what is accepted.
/// \param name  of the file, for messages
EventFile parse_events(const std::string& name, std::string_view text);

/// The file that --events names. Throws InputError likewise.
std::shared_ptr<const EventFile> read_events(const std::string& file);

}  // namespace pelagic::tools
