// Disturbances of dynamic waves as a CSV file. Its first line names the columns, in any order, and
// each further line is one event.
//
//   time, x, z         seconds, metres: when and where in the world; required
//   radius, height     metres: width and height of the shape (below 0: depth); required
//   velocity, heading  m/s, and degrees from east (+x) towards south (+z): motion of a source
//   duration           seconds of a source; 0 or absent: the disturbance acts once
//   length             metres: half the length of a hull, whose half beam is the radius; 0 or
//                      absent: the shape is round
//   mode               impulse, pressure, relaxation or foam (sim/disturbance.hpp); by default
//                      impulse for one that acts once, pressure for a source
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
    Disturbance push;  ///< at `time_s`, with its velocity
};

struct EventFile {
    static constexpr std::size_t max_bytes = std::size_t{16} << 20, max_events = 100'000;
    static constexpr double longest_s = 86400;  ///< of an event

    std::string text;                ///< the file's bytes
    std::string digest;              ///< XXH3 of the text
    std::vector<WaterEvent> events;  ///< at least one, in the order of the rows

    double first_s() const;
};

/// Parses a file's text. Throws InputError with one line that names the file, the line, the column,
/// its value and what is accepted. \param name  of the file, for messages
EventFile parse_events(const std::string& name, std::string_view text);

/// Reads and parses the file of --events. Throws InputError as parse_events() does.
std::shared_ptr<const EventFile> read_events(const std::string& file);

}  // namespace pelagic::tools
