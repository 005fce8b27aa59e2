// What the pixels of an export mean, once: sea.json says it to programs, `pelagic export --help` to people.
#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "pelagic/sim/forecast.hpp"
#include "pelagic/tools/map_options.hpp"

namespace pelagic::tools {

/// For each map that is written its channels in order: {"channel", "name", "unit", "scale", "offset", "range"}. A value
/// is scale * c + offset, where c is the pixel, of a byte its part of 255. Bytes are made by equations 50 and 51.
nlohmann::ordered_json channels_as_json(const MapOptions& options);

/// Where a texel rests and is sampled: {"axes", "x_m_of_column", "z_m_of_row", "u_of_column", ...}, each as a scale and an
/// offset of its number from 0.
nlohmann::ordered_json layout_as_json(const Forecast& forecast);

/// The same in words, a few lines.
std::string pixel_meaning();

}  // namespace pelagic::tools
