// Wind as people say it: knots, Beaufort, and where it comes from.
#pragma once

#include <optional>
#include <string_view>

namespace pelagic::tools {

/// Metres a second of "9", "9m/s", "20kn", "20knots", "40km/h", "25mph" or "bft6", with or without a blank before the unit; none for
/// anything else. A force B of the Beaufort scale is 0.836 B^(3/2) m/s, its mean speed 10 m above the sea (World
/// Meteorological Organization, The Beaufort Scale of Wind Force, Marine Science Affairs report 3, 1970); B is 1 to 12.
std::optional<double> parse_speed_mps(std::string_view text);
inline constexpr const char* speed_units = "m/s, or with a unit such as 20kn, 20knots, 40km/h, 25mph, bft6";

/// Degrees of --wind-direction, where it blows towards, from +x (east) towards +z (south), of "from-NW" or "to-SE": one of
/// the compass's 16 points, north along -z. None for anything else.
std::optional<double> parse_compass_deg(std::string_view text);

/// "NW" and the like, which don't say whether the wind comes from there or goes there.
bool is_compass_point(std::string_view text);

}  // namespace pelagic::tools
