// `pelagic info --measure`: what an export holds, beside what was asked for.
#pragma once

#include <filesystem>
#include <optional>

#include "pelagic/tools/record/sea_json.hpp"

namespace pelagic::tools {

/// Reads every frame of an export and measures its waves: {"frames", "method", "waves", "by_frequency", "by_wave_number"}, where
/// each figure has what was found, what this seed drew, and what is expected of the options. Shows progress on a terminal.
/// Throws as ExportReader does.
Json measure_export(const std::filesystem::path& folder);

/// Both spectra of such a measurement as an image.
std::string measurement_as_svg(const Json& measured);

/// The same as a table on standard output, without the spectra.
void print_measurement(const Json& measured);

}  // namespace pelagic::tools
