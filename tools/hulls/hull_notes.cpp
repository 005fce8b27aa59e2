#include "pelagic/tools/hulls/hull_notes.hpp"

#include <algorithm>
#include <numbers>

#include "pelagic/floating/wamit_files.hpp"
#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/dispersion.hpp"
#include "pelagic/sim/statistics.hpp"

namespace pelagic::tools {
namespace {

// The limits of docs/floating.md, which tests/hull_response_test.cpp reach.
constexpr double max_edge_over_length = 0.1, min_wave_over_length = 0.75, max_kt = 2.7, max_ka = 0.45;
/// Texels of the shortest waves that velocities have (WaterLevels::shortest_velocity_texels).
constexpr double texels_of_wave = WaterLevels::shortest_velocity_texels;

std::string text_of(double value) { return rounded_text(value, 3); }

std::string period_text(const char* name, double period_s) {
    return std::string(name) + " " + (period_s > 0 ? text_of(period_s) + " s" : "none");
}

}  // namespace

std::vector<std::string> notes_on(const Hull& hull, const SeaState& sea) {
    const HullAfloat& afloat = hull.afloat();
    const glm::dvec3 size = hull.mesh().upper_m() - hull.mesh().lower_m();
    const double length_m = std::max(size.x, size.z), beam_m = std::min(size.x, size.z);
    const double peak_m = expected_waves(sea).peak_wavelength_m;
    std::vector<std::string> notes = {"natural periods: " + period_text("heave", afloat.heave_period_s) + ", " +
                                      period_text("roll", afloat.roll_period_s) + ", " +
                                      period_text("pitch", afloat.pitch_period_s) +
                                      "; length over peak wavelength: " + text_of(length_m / peak_m)};
    const auto note = [&](bool is_out, const std::string& text) {
        if (is_out) notes.push_back(text);
    };
    const double edge = hull.longest_edge_m() / std::max(length_m, size.y);
    note(edge > 1.001 * max_edge_over_length, "the mesh has edges of " + text_of(edge) +
                                                  " of the hull's length, expected at most 0.1: long edges of a mesh "
                                                  "of fewer triangles are divided");
    const CascadePlan finest = plan_cascades(sea).back();
    const double shortest_m = texels_of_wave * finest.grid.side_m / finest.resolution;
    note(shortest_m > min_wave_over_length * length_m,
         "the grid has velocities of waves from " + text_of(shortest_m) + " m on, expected at most 0.75 of the hull's "
         "length, " + text_of(min_wave_over_length * length_m) + " m");
    const double k = 2 * std::numbers::pi / peak_m;
    if (const ForceTable* const given = hull.diffraction()) {
        // JONSWAP has 95 % of its variance below twice its peak's frequency.
        const double peak_radps = angular_frequency(k, sea.depth_m), highest_radps = given->omega_radps.back();
        note(highest_radps < 2 * peak_radps, "the highest frequency of the wave forces is " + text_of(highest_radps) +
                                                 " rad/s, expected at least twice that of the peak, " +
                                                 text_of(2 * peak_radps) + " rad/s");
        return notes;
    }
    note(peak_m < min_wave_over_length * length_m,
         "the peak wavelength over the hull's length is " + text_of(peak_m / length_m) +
             ", expected at least 0.75: shorter waves are diffracted");
    note(k * afloat.draught_m > max_kt, "kT, peak wave number times draught, is " + text_of(k * afloat.draught_m) +
                                            ", expected at most 2.7");
    note(k * beam_m / 2 > max_ka, "ka, peak wave number times half the beam, is " + text_of(k * beam_m / 2) +
                                      ", expected at most 0.45: waves are diffracted");
    return notes;
}

}  // namespace pelagic::tools
