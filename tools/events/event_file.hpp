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
//   hull               mesh file, relative to the events file, of a hull that moves as a source:
//                      its pressure is that of its volume below the water; height is minus its
//                      draught, and radius and length have no effect
#pragma once

#include <cstddef>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/floating/hull_mesh.hpp"
#include "pelagic/sim/disturbance.hpp"

namespace pelagic::tools {

struct WaterEvent {
    double time_s = 0, duration_s = 0;
    Disturbance push;  ///< at `time_s`, with its velocity
    /// Whose shape replaces that of `push`, with a draught of -push.height_m; null: none.
    std::shared_ptr<const HullMesh> hull = {};
};

struct EventFile {
    static constexpr std::size_t max_bytes = std::size_t{16} << 20, max_events = 100'000;
    static constexpr double longest_s = 86400;    ///< of an event
    static constexpr std::size_t max_hulls = 64;  ///< different files

    std::string text;                ///< the file's bytes
    std::string digest;              ///< XXH3 of the text
    std::vector<WaterEvent> events;  ///< in the order of the rows; at least one in a file

    double first_s() const;  ///< \pre there are events
};

/// Parses a file's text. Throws InputError with one line that names the file, the line, the column,
/// its value and what is accepted. Reads files of hulls. \param name  path of the file
EventFile parse_events(const std::string& name, std::string_view text);

/// Reads and parses the file of --events. Throws InputError as parse_events() does.
std::shared_ptr<const EventFile> read_events(const std::string& file);

}  // namespace pelagic::tools
