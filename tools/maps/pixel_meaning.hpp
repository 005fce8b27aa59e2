// Meaning of the pixels of an export: as JSON for sea.json, and as text for `pelagic export
// --help`.
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

/// Meaning of a channel: the value in its unit is scale c + offset. c is the pixel's value;
/// integers are divided by 255 or 65535.
struct ChannelMeaning {
    std::string_view channel, name, unit;
    double scale, offset;
    std::array<double, 2> range;  ///< range of values; {0, 0}: unlimited
};

/// Returns the channels in the order of the pixel's values.
std::vector<ChannelMeaning> channel_meanings(MapKind map, const MapOptions& options);

/// Returns for each exported map its channels in order: {"channel", "name", "unit", "type",
/// "scale", "offset", "range"}.
/// \param has_dynamic_waves  true if the export has a map of dynamic waves
nlohmann::ordered_json channels_as_json(const MapOptions& options, bool has_dynamic_waves);

/// Position of a dynamic-wave grid: indices of its lowest texels. Texel i is at i texel_m.
struct GridRecord {
    int resolution = 0;
    double texel_m = 0;
    std::int64_t first_x = 0, first_z = 0;
};

/// Returns {"resolution", "texel_m", "first_x", "first_z", "x_m_of_column", "z_m_of_row" (with z up
/// "y_m_of_row")}.
nlohmann::ordered_json dynamic_waves_layout_as_json(const GridRecord& grid, const MapOptions& options);

/// Returns {"side_m", "resolution", "x_m_of_column", "z_m_of_row" (with z up "y_m_of_row")}.
/// \pre options.foam_patch is set
nlohmann::ordered_json foam_patch_layout_as_json(const MapOptions& options);

/// Returns the reference positions and texture coordinates of texels: {"axes", "x_m_of_column",
/// "z_m_of_row" (with z up "y_m_of_row"), "u_of_column", ...}. Each is a scale and an offset of the
/// index, which starts at 0.
nlohmann::ordered_json layout_as_json(const Forecast& forecast, const MapOptions& options);

/// Returns the help text about pixel values, several lines.
std::string pixel_meaning();

}  // namespace pelagic::tools
