// What the pixels of an export mean, once: sea.json says it to programs, `pelagic export --help` to people.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/sim/forecast.hpp"
#include "pelagic/tools/maps/map_options.hpp"

namespace pelagic::tools {

/// What a channel of a map holds: a value in its unit is scale c + offset, where c is the pixel, of a byte its part of 255, of 16 bits
/// their part of 65535.
struct ChannelMeaning {
    std::string_view channel, name, unit;
    double scale, offset;
    std::array<double, 2> range;  ///< of values, {0, 0} where there is no limit
};

/// In the order of the pixels' values.
std::vector<ChannelMeaning> channel_meanings(MapKind map, const MapOptions& options);

/// For each map that is written its channels in order: {"channel", "name", "unit", "type", "scale", "offset", "range"}.
/// \param has_dynamic_waves  there is a map of dynamic waves, too
nlohmann::ordered_json channels_as_json(const MapOptions& options, bool has_dynamic_waves);

/// Where a dynamic-wave grid lies: its lowest texels, of which texel i stands at i texel_m.
struct GridRecord {
    int resolution = 0;
    double texel_m = 0;
    std::int64_t first_x = 0, first_z = 0;
};

/// {"resolution", "texel_m", "first_x", "first_z", "x_m_of_column", "z_m_of_row" (with z up "y_m_of_row")}.
nlohmann::ordered_json dynamic_waves_layout_as_json(const GridRecord& grid, const MapOptions& options);

/// Where a texel rests and is sampled: {"axes", "x_m_of_column", "z_m_of_row" (with z up "y_m_of_row"), "u_of_column", ...}, each as a scale and an
/// offset of its number from 0.
nlohmann::ordered_json layout_as_json(const Forecast& forecast, const MapOptions& options);

/// The same in words, a few lines.
std::string pixel_meaning();

}  // namespace pelagic::tools
