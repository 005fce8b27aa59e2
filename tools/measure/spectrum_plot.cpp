#include "pelagic/tools/measure/spectrum_plot.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace pelagic::tools {
namespace {

constexpr double panel_width = 560, panel_height = 420;  ///< of a panel's axes, in SVG units
constexpr double left_margin = 110, top_margin = 100, bottom_margin = 80, right_margin = 30;
constexpr double max_decades = 5;  ///< below the largest density; smaller densities are omitted
constexpr const char* found_colour = "#d62728";
constexpr const char* model_colour = "#1f77b4";

template <class... Values>
std::string plot_text(const char* format, Values... values) {
    char text[400];
    std::snprintf(text, sizeof text, format, values...);
    return text;
}

/// Logarithmic axis, base 10, from 10^`min` to 10^`max` on `size` units.
struct Axis {
    double min, max, size;
    std::vector<double> ticks = {1};  ///< in each decade
    double place(double value) const { return std::max(0.0, (std::log10(value) - min) / (max - min) * size); }
    bool holds(double value) const {
        constexpr double rounding = 1e-9;
        return value > 0 && std::log10(value) >= min - rounding && std::log10(value) <= max + rounding;
    }
};

/// Returns an axis over the values, at most `decades` below the largest. It begins and ends with a
/// tick.
Axis axis_over(const std::vector<double>& values, double decades, double size) {
    double max = -300;
    for (const double value : values)
        if (value > 0) max = std::max(max, std::log10(value));
    double min = max;
    for (const double value : values)
        if (value > 0) min = std::min(min, std::max(std::log10(value), max - decades));
    if (max < -299) return {0, 1, size};
    const std::vector<double> ticks = max - min < 2 ? std::vector<double>{1, 2, 5} : std::vector<double>{1};
    double first = std::floor(min), last = std::ceil(max);
    for (double decade = std::floor(min); decade <= std::ceil(max); ++decade)
        for (const double factor : ticks) {
            const double tick = decade + std::log10(factor);
            if (tick <= min) first = std::max(first, tick);
            if (tick >= max) last = std::min(last, tick);
        }
    return {first, last > first ? last : first + 1, size, ticks};
}

std::string axes_as_svg(const Axis& across, const Axis& up, const SpectrumPanel& panel) {
    std::string svg =
        plot_text("<rect width=\"%g\" height=\"%g\" fill=\"none\" stroke=\"black\"/>\n", panel_width, panel_height);
    const auto each_tick = [](const Axis& axis, auto draw) {
        for (double decade = std::floor(axis.min); decade <= axis.max; ++decade)
            for (const double factor : axis.ticks)
                if (const double value = factor * std::pow(10, decade); axis.holds(value))
                    draw(axis.place(value), value);
    };
    each_tick(across, [&](double x, double value) {
        svg += plot_text("<path d=\"M%.1f 0V%g\" stroke=\"#ddd\"/>\n", x, panel_height);
        svg += plot_text("<text x=\"%.1f\" y=\"%g\" text-anchor=\"middle\">%g</text>\n", x, panel_height + 26, value);
    });
    each_tick(up, [&](double y, double value) {
        svg += plot_text("<path d=\"M0 %.1fH%g\" stroke=\"#ddd\"/>\n", panel_height - y, panel_width);
        svg += plot_text("<text x=\"-8\" y=\"%.1f\" text-anchor=\"end\">%g</text>\n", panel_height - y + 5, value);
    });
    svg += plot_text("<text x=\"%g\" y=\"%g\" text-anchor=\"middle\">", panel_width / 2, panel_height + 56) +
           panel.at_label + "</text>\n";
    svg += plot_text("<text transform=\"translate(%g %g) rotate(-90)\" text-anchor=\"middle\">", -80.0,
                     panel_height / 2) +
           panel.density_label + "</text>\n";
    svg += plot_text("<text x=\"0\" y=\"-12\">") + panel.title + "</text>\n";
    return svg;
}

std::string curve_as_svg(const Axis& across, const Axis& up, const SpectrumPanel& panel,
                         double PlottedPoint::*density, const char* style) {
    std::string path;
    bool is_down = false;
    for (const PlottedPoint& point : panel.points) {
        if (!across.holds(point.at) || !up.holds(point.*density)) {
            is_down = false;
            continue;
        }
        path += plot_text("%c%.1f %.1f", is_down ? 'L' : 'M', across.place(point.at),
                          panel_height - up.place(point.*density));
        is_down = true;
    }
    return "<path d=\"" + path + "\" fill=\"none\" " + style + "/>\n";
}

std::string panel_as_svg(const SpectrumPanel& panel) {
    std::vector<double> places, densities;
    for (const PlottedPoint& point : panel.points) densities.insert(densities.end(), {point.found, point.model});
    const Axis up = axis_over(densities, max_decades, panel_height);
    for (const PlottedPoint& point : panel.points)
        if (up.holds(point.found) || up.holds(point.model)) places.push_back(point.at);
    const Axis across = axis_over(places, 300, panel_width);
    const std::string found = plot_text("stroke=\"%s\" stroke-width=\"2\"", found_colour);
    const std::string expected = plot_text("stroke=\"%s\" stroke-width=\"2\" stroke-dasharray=\"7 4\"", model_colour);
    return axes_as_svg(across, up, panel) + curve_as_svg(across, up, panel, &PlottedPoint::model, expected.c_str()) +
           curve_as_svg(across, up, panel, &PlottedPoint::found, found.c_str()) +
           plot_text("<text x=\"%g\" y=\"25\" text-anchor=\"end\" fill=\"%s\">found</text>\n", panel_width - 10,
                     found_colour) +
           plot_text("<text x=\"%g\" y=\"47\" text-anchor=\"end\" fill=\"%s\">expected</text>\n", panel_width - 10,
                     model_colour);
}

}  // namespace

std::string spectra_as_svg(const std::string& title, const std::vector<SpectrumPanel>& panels) {
    const double step = left_margin + panel_width + right_margin;
    const double whole = step * static_cast<double>(panels.size());
    std::string svg = plot_text(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 %g %g\" font-family=\"sans-serif\" "
        "font-size=\"16\">\n",
        whole, top_margin + panel_height + bottom_margin);
    svg += "<title>" + title + "</title>\n<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n";
    svg += plot_text("<text x=\"%g\" y=\"40\" text-anchor=\"middle\" font-size=\"20\">", whole / 2) + title +
           "</text>\n";
    for (std::size_t i = 0; i < panels.size(); ++i)
        svg += plot_text("<g transform=\"translate(%g %g)\">\n", left_margin + step * static_cast<double>(i),
                         top_margin) +
               panel_as_svg(panels[i]) + "</g>\n";
    return svg + "</svg>\n";
}

}  // namespace pelagic::tools
