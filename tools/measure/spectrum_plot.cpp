#include "pelagic/tools/measure/spectrum_plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pelagic::tools {
namespace {

constexpr double width = 560, height = 420;  ///< of a panel's axes, in SVG units
constexpr double left = 80, top = 50, below = 70, between = 40;
constexpr double most_decades = 5;  ///< below the largest density: less is nothing
constexpr const char* found_colour = "#d62728";
constexpr const char* asked_colour = "#1f77b4";

template <class... Values>
std::string line(const char* format, Values... values) {
    char text[400];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

/// Base-10 logarithms from `least` to `most` on `size` units.
struct Axis {
    double least, most, size;
    double place(double value) const { return (std::log10(value) - least) / (most - least) * size; }
    bool holds(double value) const { return value > 0 && std::log10(value) >= least && std::log10(value) <= most; }
};

/// The span of the values, of which at most `decades` below the largest count; a tenth of a decade wider at both ends.
Axis axis_over(const std::vector<double>& values, double decades, double size) {
    double most = -300;
    for (const double value : values)
        if (value > 0) most = std::max(most, std::log10(value));
    double least = most;
    for (const double value : values)
        if (value > 0) least = std::min(least, std::max(std::log10(value), most - decades));
    if (most < -299) return {0, 1, size};
    return {least - 0.1, most + 0.1, size};
}

std::string axes_as_svg(const Axis& across, const Axis& up, const SpectrumPanel& panel) {
    std::string svg = line("<rect width=\"%g\" height=\"%g\" fill=\"none\" stroke=\"black\"/>\n", width, height);
    const auto each_tick = [](const Axis& axis, auto draw) {
        for (double decade = std::floor(axis.least); decade <= axis.most; ++decade)
            for (const double factor : {1.0, 2.0, 5.0})
                if (const double value = factor * std::pow(10, decade); axis.holds(value))
                    draw(axis.place(value), value, factor == 1 || axis.most - axis.least < 2);
    };
    each_tick(across, [&](double x, double value, bool is_labelled) {
        svg += line("<path d=\"M%.1f 0V%g\" stroke=\"#ddd\"/>\n", x, height);
        if (is_labelled)
            svg += line("<text x=\"%.1f\" y=\"%g\" text-anchor=\"middle\">%g</text>\n", x, height + 20, value);
    });
    each_tick(up, [&](double y, double value, bool is_labelled) {
        svg += line("<path d=\"M0 %.1fH%g\" stroke=\"#ddd\"/>\n", height - y, width);
        if (is_labelled)
            svg += line("<text x=\"-8\" y=\"%.1f\" text-anchor=\"end\">%g</text>\n", height - y + 5, value);
    });
    svg += line("<text x=\"%g\" y=\"%g\" text-anchor=\"middle\">", width / 2, height + 45) + panel.at_label +
           "</text>\n";
    svg += line("<text x=\"0\" y=\"-10\">") + panel.title + ", " + panel.density_label + "</text>\n";
    return svg;
}

std::string curve_as_svg(const Axis& across, const Axis& up, const SpectrumPanel& panel,
                         double PlottedPoint::*density, const char* look) {
    std::string path;
    bool is_down = false;
    for (const PlottedPoint& point : panel.points) {
        if (!across.holds(point.at) || !up.holds(point.*density)) {
            is_down = false;
            continue;
        }
        path += line("%c%.1f %.1f", is_down ? 'L' : 'M', across.place(point.at), height - up.place(point.*density));
        is_down = true;
    }
    return "<path d=\"" + path + "\" fill=\"none\" " + look + "/>\n";
}

std::string panel_as_svg(const SpectrumPanel& panel) {
    std::vector<double> places, densities;
    for (const PlottedPoint& point : panel.points) {
        places.push_back(point.at);
        densities.insert(densities.end(), {point.found, point.asked_for});
    }
    const Axis across = axis_over(places, 300, width), up = axis_over(densities, most_decades, height);
    const std::string found = line("stroke=\"%s\" stroke-width=\"2\"", found_colour);
    const std::string asked = line("stroke=\"%s\" stroke-width=\"2\" stroke-dasharray=\"7 4\"", asked_colour);
    return axes_as_svg(across, up, panel) + curve_as_svg(across, up, panel, &PlottedPoint::asked_for, asked.c_str()) +
           curve_as_svg(across, up, panel, &PlottedPoint::found, found.c_str()) +
           line("<text x=\"%g\" y=\"25\" text-anchor=\"end\" fill=\"%s\">found</text>\n", width - 10, found_colour) +
           line("<text x=\"%g\" y=\"47\" text-anchor=\"end\" fill=\"%s\">asked for</text>\n", width - 10,
                asked_colour);
}

}  // namespace

std::string spectra_as_svg(const std::vector<SpectrumPanel>& panels) {
    const double step = left + width + between;
    std::string svg = line(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" font-family=\"sans-serif\" "
        "font-size=\"16\">\n<rect width=\"100%%\" height=\"100%%\" fill=\"white\"/>\n",
        step * static_cast<double>(panels.size()), top + height + below);
    for (std::size_t i = 0; i < panels.size(); ++i)
        svg += line("<g transform=\"translate(%g %g)\">\n", left + step * static_cast<double>(i), top) +
               panel_as_svg(panels[i]) + "</g>\n";
    return svg + "</svg>\n";
}

}  // namespace pelagic::tools
