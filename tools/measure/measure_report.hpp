// `pelagic info --measure`: measured waves of an export beside those expected from its options.
#pragma once

#include <filesystem>
#include <optional>

#include "pelagic/tools/record/sea_json.hpp"

namespace pelagic::tools {

/// Reads every frame of an export and measures its waves: {"frames", "method", "waves",
/// "by_frequency", "by_wave_number"}. Each statistic has the measured value, the value drawn by the
/// seed, and the value expected from the options. Shows progress on a terminal. Throws as
/// ExportReader does.
Json measure_export(const std::filesystem::path& folder);

/// Returns both spectra of a measurement as an SVG image.
std::string measurement_as_svg(const Json& measured);

/// Prints a measurement as a table on stdout, without the spectra.
void print_measurement(const Json& measured);

}  // namespace pelagic::tools
