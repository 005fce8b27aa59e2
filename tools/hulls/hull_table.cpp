#include "pelagic/tools/hulls/hull_table.hpp"

#include <array>
#include <numbers>

#include "pelagic/message/number_text.hpp"

namespace pelagic::tools {
namespace {

constexpr std::array hull_column_names = {"time", "x",  "y",  "z",  "heave",   "heading",  "pitch",
                                          "roll", "vx", "vy", "vz", "draught", "displaced"};

}  // namespace

std::string hull_columns() {
    std::string text;
    for (const char* name : hull_column_names) text.append(text.empty() ? "" : ",").append(name);
    return text;
}

std::string hull_row(double time_s, const HullMoment& moment, bool as_json) {
    constexpr double degrees = 180 / std::numbers::pi;
    const HullState& state = moment.state;
    const std::array<double, hull_column_names.size()> values = {time_s,
                                                                 state.position_m.x,
                                                                 state.position_m.y,
                                                                 state.position_m.z,
                                                                 moment.heave_m,
                                                                 moment.heading_rad * degrees,
                                                                 moment.pitch_rad * degrees,
                                                                 moment.roll_rad * degrees,
                                                                 state.velocity_mps.x,
                                                                 state.velocity_mps.y,
                                                                 state.velocity_mps.z,
                                                                 moment.draught_m,
                                                                 moment.displaced_m3};
    std::string text = as_json ? "{" : "";
    for (std::size_t i = 0; i < hull_column_names.size(); ++i) {
        if (i > 0) text += ',';
        if (as_json) text.append("\"").append(hull_column_names[i]).append("\":");
        // Angles come from libm, whose last digits differ between systems.
        text += i == 0 ? number_text(values[i]) : rounded_text(values[i], 9);
    }
    return as_json ? text + "}" : text;
}

}  // namespace pelagic::tools
