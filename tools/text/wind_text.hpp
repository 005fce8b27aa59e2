// Parsing of wind speeds (knots, Beaufort) and of compass directions.
#pragma once

#include <optional>
#include <string_view>

namespace pelagic::tools {

/// Parses "9", "9m/s", "20kn", "20knots", "40km/h", "25mph" or "bft6", with or without a blank
/// before the unit. Returns m/s, or none for anything else.
/// A force B of the Beaufort scale, 1 to 12, is 0.836 B^(3/2) m/s, the mean speed 10 m above the
/// sea (World Meteorological Organization, The Beaufort Scale of Wind Force, Marine Science Affairs
/// report 3, 1970).
std::optional<double> parse_speed_mps(std::string_view text);
inline constexpr const char* speed_units = "m/s, or with a unit such as 20kn, 20knots, 40km/h, 25mph, bft6";

/// Parses "from-NW" or "to-SE": one of the 16 compass points, north along -z. Returns the angle of
/// --wind-direction, in degrees: the direction towards which the wind blows, from +x (east) towards
/// +z (south). None for anything else.
std::optional<double> parse_compass_deg(std::string_view text);

/// Returns true for a compass point such as "NW" without "from-" or "to-", which is ambiguous.
bool is_compass_point(std::string_view text);

}  // namespace pelagic::tools
