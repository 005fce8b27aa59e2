// Motion of boats as a table and as a chart.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pelagic/examples/buoyancy/floating_box.hpp"

namespace pelagic::buoyancy {

/// Angles of a box in degrees: pitch positive with the bow up, roll positive with the starboard
/// side down.
struct Attitude {
    double pitch_deg, roll_deg;
};
Attitude attitude_of(const BoxState&);

struct Moment {
    double time_s, heave_m;
    Attitude attitude;
};

struct BoatTrace {
    std::string name;
    std::vector<Moment> moments;  ///< all boats have equal times
};

/// Writes time_s, boat, heave_m, pitch_deg and roll_deg, one line per boat and time.
/// \throws std::runtime_error  with the file and the reason if the file cannot be written
void write_csv(const std::filesystem::path& file, const std::vector<BoatTrace>& boats);

/// Writes charts of heave, pitch and roll over time, with one curve per boat (at most three).
/// \throws std::runtime_error  as write_csv() does
void write_svg(const std::filesystem::path& file, const std::string& title, const std::vector<BoatTrace>& boats);

}  // namespace pelagic::buoyancy
