// Conversion of a record's keys to the options of `pelagic export`.
#pragma once

#include <string>
#include <string_view>

#include "pelagic/tools/record/sea_json.hpp"

namespace pelagic::tools {

/// Returns "--start" for "start_s", a key under "export". Keys of a nested object are appended to
/// the key of the object: "mesh_side_m" is --mesh-size.
std::string flag_of(const std::string& key);

/// Returns "--wind-speed" for "/sea/wind_speed_mps", a JSON pointer (RFC 6901) into
/// options_as_json(). Returns --weather for a value in a change of the weather, and the key itself
/// for a value that no option sets: "version".
std::string flag_at(std::string_view pointer);

/// Formats a value as on a command line; lists are separated by commas.
std::string typed_value(const Json& value);

}  // namespace pelagic::tools
