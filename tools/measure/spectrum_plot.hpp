// Plots of measured and expected spectra: SVG, logarithmic axes.
#pragma once

#include <string>
#include <vector>

namespace pelagic::tools {

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
