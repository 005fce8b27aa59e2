// From a key of a record to the option of `pelagic export` that it came from.
#pragma once

#include <string>
#include <string_view>

#include "pelagic/tools/record/sea_json.hpp"

namespace pelagic::tools {

/// "--start" of "start_s", a key under "export"; keys of an object within it follow its own: "mesh_side_m" is --mesh-size.
std::string flag_of(const std::string& key);

/// "--wind-speed" of "/sea/wind_speed_mps", a JSON pointer (RFC 6901) into what options_as_json() returns. A part of a change of
/// the weather gives --weather, and what no option sets its own name: "version".
std::string flag_at(std::string_view pointer);

/// A value as it is typed on a command line, lists with commas.
std::string typed_value(const Json& value);

}  // namespace pelagic::tools
