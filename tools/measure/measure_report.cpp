#include "pelagic/tools/measure/measure_report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <vector>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/tools/measure/export_reader.hpp"
#include "pelagic/tools/measure/wave_measurement.hpp"
#include "pelagic/tools/text/progress.hpp"

namespace pelagic::tools {
namespace {

/// Returns a measured spectrum with the model's values at its points.
Json spectrum_json(const std::vector<SpectrumPoint>& found, const char* at, const char* unit, auto model) {
    std::vector<double> places;
    for (const SpectrumPoint& point : found) places.push_back(point.at);
    const std::vector<double> modelled = model(places);
    Json list = Json::array();
    for (std::size_t i = 0; i < found.size(); ++i)
        list.push_back({{at, found[i].at},
                        {std::string("found_") + unit, found[i].density},
                        {std::string("expected_") + unit, modelled[i]}});
    return list;
}

template <class Value>
Json or_null(const std::optional<Value>& value) {
    return value ? Json(*value) : Json();
}

/// A wave system of the exported sea.
struct NamedSystem {
    std::string name;  ///< "wind_sea", "swell", "system_1"
    SeaState alone;    ///< the sea without the other systems
    SystemReport report;
};

/// Returns the systems of which the report has statistics.
std::vector<NamedSystem> systems_of(const SeaState& sea, const SeaReport& report) {
    SeaState wind_sea = sea, others = sea;
    wind_sea.swell_height_m = 0;
    wind_sea.systems.clear();
    others.spectrum = SpectrumModel::none;
    SeaState swell = others;
    swell.systems.clear();
    others.swell_height_m = 0;
    std::vector<NamedSystem> all;
    if (report.wind_sea) all.push_back({"wind_sea", wind_sea, *report.wind_sea});
    if (report.swell) all.push_back({"swell", swell, *report.swell});
    for (std::size_t i = 0; i < report.systems.size(); ++i) {
        others.systems = {sea.systems[i]};
        all.push_back({"system_" + number_text(i + 1), others, report.systems[i]});
    }
    return all;
}

/// Peak period of a density by frequency (Young 1995).
struct PeakSum {
    double weight = 0, weighted = 0;
    void add(double hertz, double density) {
        const double fourth = (density * density) * (density * density);
        weight += fourth;
        weighted += fourth * hertz;
    }
    std::optional<double> period() const { return weighted > 0 ? std::optional(weight / weighted) : std::nullopt; }
};

/// Splits the measured density at each frequency in the ratio that the systems have in the model, and
/// returns the peak period of each; none for a system with no energy in the series.
std::vector<std::optional<double>> peaks_of_systems(const std::vector<SpectrumPoint>& found,
                                                    const std::vector<NamedSystem>& systems) {
    std::vector<double> at;
    for (const SpectrumPoint& point : found) at.push_back(point.at);
    std::vector<double> all(at.size());
    std::vector<std::vector<double>> densities;
    for (const NamedSystem& system : systems) {
        const std::vector<double>& of_system = densities.emplace_back(model_by_frequency(system.alone, at));
        for (std::size_t i = 0; i < at.size(); ++i) all[i] += of_system[i];
    }
    std::vector<std::optional<double>> peaks;
    for (const std::vector<double>& of_system : densities) {
        PeakSum sum;
        for (std::size_t i = 0; i < at.size(); ++i)
            if (all[i] > 0) sum.add(at[i], found[i].density * (of_system[i] / all[i]));
        peaks.push_back(sum.period());
    }
    return peaks;
}

/// Returns measured, realised and expected statistics. A realised value is null if it can be measured
/// from frames only.
Json wave_statistics_json(const MeasuredWaves& found, const SeaState& sea, const SeaReport& report) {
    const auto three = [](Json measured, Json realised, Json expected) -> Json {
        return {{"found", measured}, {"realised", realised}, {"expected", expected}};
    };
    const auto direction = [](double WaveDirections::*angle, const WaveDirections& of) {
        return in_degrees(of.*angle);
    };
    const auto directions = [&](double WaveDirections::*angle) {
        return three(found.directions ? Json(direction(angle, *found.directions)) : Json(),
                     direction(angle, report.realised_directions), direction(angle, report.expected_directions));
    };
    Json json = {
        {"significant_wave_height_m",
         three(found.significant_wave_height_m, report.realised_significant_wave_height_m,
               report.expected.significant_wave_height_m)},
        {"peak_period_s",
         three(or_null(found.peak_period_s), report.realised_peak_period_s, report.expected.peak_period_s)},
        {"peak_wavelength_m", three(or_null(found.peak_wavelength_m), Json(), report.expected.peak_wavelength_m)},
        {"mean_direction_deg", directions(&WaveDirections::mean_rad)},
        {"directional_spread_deg", directions(&WaveDirections::spread_rad)},
        {"tm01_s", three(or_null(found.tm01_s), report.realised_periods.tm01_s, report.expected_periods.tm01_s)},
        {"tm02_s", three(or_null(found.tm02_s), report.realised_periods.tm02_s, report.expected_periods.tm02_s)},
        {"zero_crossing_period_s", three(or_null(found.zero_crossing_period_s), report.realised_periods.tm02_s,
                                         report.expected_periods.tm02_s)}};
    const std::vector<NamedSystem> systems = systems_of(sea, report);
    const std::vector<std::optional<double>> peaks = peaks_of_systems(found.by_harmonic, systems);
    for (std::size_t i = 0; i < systems.size(); ++i) {
        const SystemReport& of = systems[i].report;
        json[systems[i].name + "_peak_period_s"] =
            three(or_null(peaks[i]), or_null(of.realised_peak_period_s), of.peak_period_s);
        // The peak of the sum may lie between the peaks of two systems. Use the system that has the peak
        // of the model.
        if (report.realised_peak_period_s == of.realised_peak_period_s)
            json["peak_period_s"]["found"] = or_null(peaks[i]);
    }
    return json;
}

std::vector<PlottedPoint> points_of(const Json& spectrum, const char* at, const std::string& unit) {
    std::vector<PlottedPoint> points;
    for (const Json& point : spectrum)
        points.push_back({point.at(at), point.at("found_" + unit), point.at("expected_" + unit)});
    return points;
}

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

Json measure_export(const std::filesystem::path& folder) {
    const ExportReader reader("--measure", folder);
    const SeaState& sea = reader.sea().sea;
    const SeaReport report = report_on(sea);
    const double whole_s = reader.step_s() * static_cast<double>(reader.frames_there());
    const bool is_one_loop = reader.frames() == reader.frames_there() && reader.frames() > 1 &&
                             std::fabs(whole_s / sea.loop_period_s - 1) < 1e-6;
    std::vector<WaveMeasurement> cascades;
    for (const CascadePlan& cascade : reader.cascades())
        cascades.emplace_back(HeightSeries{.cascade = cascade,
                                           .depth_m = sea.depth_m,
                                           .loop_period_s = sea.loop_period_s,
                                           .likely_peak_period_s = report.expected.peak_period_s,
                                           .frames = reader.frames(),
                                           .step_s = reader.step_s(),
                                           .is_one_loop = is_one_loop});
    {
        Progress progress("frame", reader.frames());
        for (std::size_t frame = 0; frame < reader.frames(); ++frame) {
            progress.show(frame);
            for (std::size_t cascade = 0; cascade < cascades.size(); ++cascade)
                cascades[cascade].add_frame(reader.heights(frame, cascade));
        }
    }
    const MeasuredWaves found = measured_waves(cascades);
    Json json = {{"version", PELAGIC_VERSION}, {"sea", sea_as_json(reader.sea())}};
    json["frames"] = {{"read", reader.frames()},
                      {"there", reader.frames_there()},
                      {"apart_s", reader.step_s()},
                      {"one_loop", is_one_loop}};
    json["cascades"] = Json::array();
    for (const CascadePlan& cascade : reader.cascades())
        json["cascades"].push_back({{"side_m", cascade.grid.side_m}, {"resolution", cascade.resolution}});
    json["cascades_there"] = plan_cascades(sea).size();
    json["method"] = {{"by_frequency", found.frequency_method}};
    json["waves"] = wave_statistics_json(found, sea, report);
    json["by_frequency"] = spectrum_json(found.by_frequency, "frequency_hz", "m2_per_hz",
                                         [&](const auto& at) { return model_by_frequency(sea, at); });
    json["by_wave_number"] = spectrum_json(found.by_wave_number, "wave_number_rad_per_m", "m3",
                                           [&](const auto& at) { return model_by_wave_number(sea, at); });
    return json;
}

std::string measurement_as_svg(const Json& measured) {
    std::vector<SpectrumPanel> panels;
    if (const Json& spectrum = measured.at("by_frequency"); !spectrum.empty())
        panels.push_back({"Spectrum by frequency", "frequency, Hz", "variance density, m²/Hz",
                          points_of(spectrum, "frequency_hz", "m2_per_hz")});
    panels.push_back({"Spectrum by wave number", "wave number, rad/m", "variance density, m³",
                      points_of(measured.at("by_wave_number"), "wave_number_rad_per_m", "m3")});
    const Json& height = measured.at("waves").at("significant_wave_height_m");
    const auto frames = measured.at("frames").at("read").get<std::size_t>();
    return spectra_as_svg("Waves of " + number_text(frames) + (frames == 1 ? " frame" : " frames") + ": Hs " +
                              rounded_text(height.at("found").get<double>(), 3) + " m found, " +
                              rounded_text(height.at("expected").get<double>(), 3) + " m expected",
                          panels);
}

void print_measurement(const Json& measured) {
    const Json& frames = measured.at("frames");
    const auto number = [](const Json& value) {
        return value.is_null() ? std::string("-") : rounded_text(value.get<double>(), 4);
    };
    std::printf("%s frame%s", number(frames.at("read")).c_str(), frames.at("read") == 1 ? "" : "s");
    if (frames.at("read") > 1)
        std::printf(", %s s apart%s", number(frames.at("apart_s")).c_str(),
                    frames.at("one_loop").get<bool>() ? ", one loop" : "");
    for (const Json& cascade : measured.at("cascades"))
        std::printf(", %s x %s texels on %s m", number(cascade.at("resolution")).c_str(),
                    number(cascade.at("resolution")).c_str(), number(cascade.at("side_m")).c_str());
    std::printf("\n%-30s%-14s%-14s%s\n", "Waves", "found", "realised", "expected");
    for (const auto& [name, value] : measured.at("waves").items())
        std::printf("  %-28s%-14s%-14s%s\n", name.c_str(), number(value.at("found")).c_str(),
                    number(value.at("realised")).c_str(), number(value.at("expected")).c_str());
    std::printf("  %-28s%s\n", "spectrum by frequency",
                measured.at("method").at("by_frequency").get<std::string>().c_str());
    if (measured.at("cascades").size() < measured.at("cascades_there"))
        std::printf(
            "note: the export has images of %zu of the sea's %s cascades: the waves of the others are not in it\n",
            measured.at("cascades").size(), number(measured.at("cascades_there")).c_str());
    if (frames.at("read") != frames.at("there"))
        std::printf("note: the export has %s frames, of which the first %s were read\n",
                    number(frames.at("there")).c_str(), number(frames.at("read")).c_str());
}

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
