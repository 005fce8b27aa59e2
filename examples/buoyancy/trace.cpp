#include "pelagic/examples/buoyancy/trace.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cerrno>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <system_error>

namespace pelagic::buoyancy {
namespace {

void write_file(const std::filesystem::path& file, const std::string& text) {
    errno = 0;
    std::ofstream out(file, std::ios::binary);
    out << text;
    out.close();
    if (!out) throw std::runtime_error(file.string() + ": " + std::generic_category().message(errno ? errno : EIO));
}

// Sizes of the chart in its units.
constexpr double width = 900, left = 60, right = 20, top = 76, panel_height = 160, panel_gap = 46;
// Okabe and Ito's colours, which are distinguishable with colour blindness.
constexpr std::array colours = {"#0072b2", "#d55e00", "#009e73"};

struct Panel {
    const char* title;
    double (*value)(const Moment&);
};
constexpr std::array<Panel, 3> panels = {{
    {"heave, m", [](const Moment& moment) { return moment.heave_m; }},
    {"pitch, degrees (bow up)", [](const Moment& moment) { return moment.attitude.pitch_deg; }},
    {"roll, degrees (starboard down)", [](const Moment& moment) { return moment.attitude.roll_deg; }},
}};

/// Returns 1, 2 or 5 times a power of ten, so that `range` contains at most `most` steps.
double tick_of(double range, int max) {
    double tick = 1e-3;
    for (int i = 0; tick * max < range; ++i) tick *= i % 3 == 1 ? 2.5 : 2;
    return tick;
}

void draw_text(std::ostream& svg, double x, double y, const char* more, const std::string& text) {
    svg << "<text x='" << x << "' y='" << y << "' " << more << ">" << text << "</text>\n";
}

void draw_panel(std::ostream& svg, const Panel& panel, double above, const std::vector<BoatTrace>& boats) {
    double max = 1e-3;
    for (const BoatTrace& boat : boats)
        for (const Moment& moment : boat.moments) max = std::max(max, std::fabs(panel.value(moment)));
    const double tick = tick_of(2 * max, 6), reach = std::ceil(max / tick) * tick;
    const double first_s = boats[0].moments.front().time_s, last_s = boats[0].moments.back().time_s;
    const double seconds = std::max(last_s - first_s, 1e-3), tick_s = tick_of(seconds, 12);
    const auto x_of = [&](double time) { return left + (time - first_s) / seconds * (width - left - right); };
    const auto y_of = [&](double value) { return above + (reach - value) / (2 * reach) * panel_height; };

    draw_text(svg, left, above - 7, "class='title'", panel.title);
    for (int i = 0; first_s + i * tick_s <= last_s + 1e-9; ++i) {
        const double x = x_of(first_s + i * tick_s);
        svg << "<line x1='" << x << "' x2='" << x << "' y1='" << above << "' y2='" << above + panel_height << "'/>\n";
        std::ostringstream label;
        label << first_s + i * tick_s << (i == 0 ? " s" : "");
        draw_text(svg, x, above + panel_height + 14, "text-anchor='middle'", label.str());
    }
    const int ticks = static_cast<int>(std::lround(reach / tick));
    for (int i = -ticks; i <= ticks; ++i) {
        const double y = y_of(i * tick);
        svg << "<line x1='" << left << "' x2='" << width - right << "' y1='" << y << "' y2='" << y << "'"
            << (i == 0 ? " class='zero'" : "") << "/>\n";
        std::ostringstream label;
        label << i * tick;
        draw_text(svg, left - 6, y + 4, "text-anchor='end'", label.str());
    }
    for (std::size_t boat = 0; boat < boats.size(); ++boat) {
        svg << "<polyline stroke='" << colours[boat] << "' points='";
        // One point per unit of width suffices.
        const std::vector<Moment>& moments = boats[boat].moments;
        const std::size_t stride = moments.size() / static_cast<std::size_t>(width) + 1;
        for (std::size_t i = 0; i < moments.size(); i += stride)
            svg << x_of(moments[i].time_s) << ',' << y_of(panel.value(moments[i])) << ' ';
        svg << "'/>\n";
    }
}

}  // namespace

Attitude attitude_of(const BoxState& state) {
    const glm::dmat3 axes = glm::mat3_cast(state.orientation);
    constexpr double degrees = 180 / std::numbers::pi;
    return {std::asin(std::clamp(axes[0].y, -1.0, 1.0)) * degrees, std::atan2(-axes[2].y, axes[1].y) * degrees};
}

void write_csv(const std::filesystem::path& file, const std::vector<BoatTrace>& boats) {
    std::ostringstream csv;
    csv << std::fixed << std::setprecision(4);
    csv << "time_s,boat,heave_m,pitch_deg,roll_deg\n";
    for (std::size_t i = 0; i < boats.at(0).moments.size(); ++i)
        for (const BoatTrace& boat : boats) {
            const Moment& moment = boat.moments[i];
            csv << moment.time_s << ',' << boat.name << ',' << moment.heave_m << ',' << moment.attitude.pitch_deg
                << ',' << moment.attitude.roll_deg << '\n';
        }
    write_file(file, csv.str());
}

void write_svg(const std::filesystem::path& file, const std::string& title, const std::vector<BoatTrace>& boats) {
    assert(!boats.empty() && boats.size() <= colours.size() && !boats[0].moments.empty());
    const double height = top + static_cast<double>(panels.size()) * (panel_height + panel_gap) - panel_gap / 2;
    std::ostringstream svg;
    svg.precision(5);
    svg << "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 " << width << ' ' << height << "'>\n<style>\n"
        << "text { font: 12px sans-serif; fill: #333 } .title { font-weight: bold }\n"
        << "line { stroke: #ddd } .zero { stroke: #888 } polyline { fill: none; stroke-width: 1.5 }\n</style>\n"
        << "<rect width='" << width << "' height='" << height << "' fill='white'/>\n";
    draw_text(svg, left, 22, "class='title'", title);
    for (std::size_t boat = 0; boat < boats.size(); ++boat) {
        const double x = left + 280 * static_cast<double>(boat);
        svg << "<polyline stroke='" << colours[boat] << "' points='" << x << ",38 " << x + 24 << ",38'/>\n";
        draw_text(svg, x + 30, 42, "", boats[boat].name);
    }
    for (std::size_t i = 0; i < panels.size(); ++i)
        draw_panel(svg, panels[i], top + static_cast<double>(i) * (panel_height + panel_gap), boats);
    svg << "</svg>\n";
    write_file(file, svg.str());
}

}  // namespace pelagic::buoyancy
