// `pelagic info --measure`: measured waves of an export beside those expected from its options.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/tools/record/sea_json.hpp"

namespace pelagic::tools {

/// Reads every frame of an export and measures its waves: {"frames", "method", "waves",
/// "by_frequency", "by_wave_number"}. Each statistic has the measured value ("found"), the value of
/// the seed ("realised"), and the value expected from the options. Shows progress on a terminal.
/// Throws as ExportReader does.
Json measure_export(const std::filesystem::path& folder);

/// Returns both spectra of a measurement as an SVG image.
std::string measurement_as_svg(const Json& measured);

/// Prints a measurement as a table on stdout, without the spectra.
void print_measurement(const Json& measured);

struct PlottedPoint {
    double at, found, model;
};

/// One diagram, labelled with quantities and units. Points with values of 0 or less are omitted.
struct SpectrumPanel {
    std::string title, at_label, density_label;
    std::vector<PlottedPoint> points;
};

/// Returns an SVG image with the panels side by side below a title. The texts are not escaped: pass
/// only trusted texts and numbers.
std::string spectra_as_svg(const std::string& title, const std::vector<SpectrumPanel>& panels);

}  // namespace pelagic::tools
