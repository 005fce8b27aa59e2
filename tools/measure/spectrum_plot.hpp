// Spectra found beside those asked for, as an image for people: SVG, logarithmic axes.
#pragma once

#include <string>
#include <vector>

namespace pelagic::tools {

struct PlottedPoint {
    double at, found, model;
};

/// One pair of axes, labelled with quantities and units. Points whose values are not above 0 are left out.
struct SpectrumPanel {
    std::string title, at_label, density_label;
    std::vector<PlottedPoint> points;
};

/// The panels side by side below a title. Texts are ours, or numbers: nothing in them is escaped.
std::string spectra_as_svg(const std::string& title, const std::vector<SpectrumPanel>& panels);

}  // namespace pelagic::tools
