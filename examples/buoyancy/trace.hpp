// How boats moved, as a table and as an image.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pelagic/examples/buoyancy/floating_box.hpp"

namespace pelagic::buoyancy {

/// Angles of a box in degrees: pitch positive with the bow up, roll positive with the starboard side down.
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
    std::vector<Moment> moments;  ///< as many as the other boats have, at the same times
};

/// time_s, boat, heave_m, pitch_deg, roll_deg; a line a boat and moment. Throws std::runtime_error with the file and
/// the reason if it can't be written.
void write_csv(const std::filesystem::path& file, const std::vector<BoatTrace>& boats);

/// Heave, pitch and roll over time, one above the other, a curve a boat (three at most). Throws as write_csv().
void write_svg(const std::filesystem::path& file, const std::string& title, const std::vector<BoatTrace>& boats);

}  // namespace pelagic::buoyancy
