#include "pelagic/gl/water/small_water.hpp"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "pelagic/analytic/pond_waves.hpp"
#include "pelagic/gl/water/scene_block.hpp"
#include "pelagic/message/invalid_value_message.hpp"

namespace pelagic::gl {
namespace {

using std::numbers::pi;

/// Returns the number of cycles in a loop of waves with the wavelength, rounded so that the loop
/// closes.
double cycles(double wavelength_m, double loop_s) {
    return std::round(ripple_frequency_hz(1 / wavelength_m) * loop_s);
}

/// Returns the elapsed fraction of the loop, [0, 1).
double loop_fraction(const SeaFacts& facts) { return fraction(facts.time_s / facts.sea.loop_period_s); }

/// Returns the mean square slope of clean water, summed over both axes (Cox and Munk 1954).
double mean_square_slope(double wind_mps) { return 0.003 + 0.00512 * wind_mps; }

/// Octaves of noise for a kind of small water.
struct Octaves {
    double largest_m;         ///< noise cell of the first octave, which is half a wavelength
    double crest_length = 1;  ///< length of crests over wavelength
    double slope_square;      ///< mean square slope of all octaves
    double slope_growth = 1;  ///< factor of the slope from one octave to the next
    double turning = 0.2;     ///< rotations of gradients per wave period; 1 looks like boiling
    double drift = 0;         ///< speed downwind over the phase speed of waves of this length
};

/// Equals noise_slope_square in small_water.glsl.
constexpr double noise_slope_square = 0.7796;
constexpr int period_cells = 64;

Octaves octaves_of_surface(Surface surface, double wind_mps) {
    const double square = mean_square_slope(wind_mps);
    if (surface == Surface::coast)
        return {
            .largest_m = 6, .crest_length = 2.2, .slope_square = 1.6 * square, .slope_growth = 0.86, .drift = 0.8};
    if (surface == Surface::river) return {.largest_m = 0.7, .slope_square = 0.03, .turning = 0.5};
    return {.largest_m = 1.6, .crest_length = 1.7, .slope_square = square, .drift = 0.6};
}

void place_octaves(SceneBlock& block, const SeaFacts& facts, glm::dvec2 viewer) {
    const SeaState& sea = facts.sea;
    const Octaves kind = octaves_of_surface(facts.surface, sea.wind_speed_mps);
    const double contraction = 1 / kind.crest_length;
    double squares = 0;
    for (std::size_t i = 0; i < block.bump_grid.size(); ++i)
        squares += std::pow(kind.slope_growth, 2. * static_cast<double>(i));
    const double first_slope =
        std::sqrt(kind.slope_square / (squares * noise_slope_square * 0.5 * (1 + contraction * contraction)));
    for (std::size_t i = 0; i < block.bump_grid.size(); ++i) {
        // The factor is slightly below one half, so that no two grids share their lines. The grids'
        // directions spread around the wind.
        const double cell_m = kind.largest_m * std::pow(0.47, i);
        const double angle = sea.wind_direction_rad + 0.9 * (fraction(static_cast<double>(i) * golden) - 0.5) * 2;
        const double c = std::cos(angle), s = std::sin(angle);
        const double turns = cycles(2 * cell_m, sea.loop_period_s);
        // Octaves drift by a whole number of periods in a loop.
        const double speed = kind.drift * turns * 2 * cell_m / sea.loop_period_s;
        const double periods = std::round(speed * sea.loop_period_s / (period_cells * cell_m));
        const double along = (c * viewer.x + s * viewer.y) / cell_m - periods * period_cells * loop_fraction(facts);
        const double across = contraction * (c * viewer.y - s * viewer.x) / cell_m;
        const auto cell = [](double place) { return fraction(std::floor(place) / period_cells) * period_cells; };
        block.bump_grid[i] = {c, s, 1 / cell_m, first_slope * std::pow(kind.slope_growth, i) * cell_m};
        block.bump_place[i] = {fraction(along), fraction(across), cell(along), cell(across)};
        const double changes = std::max(1., std::round(kind.turning * turns));
        block.bump_turn[i / 4][static_cast<int>(i % 4)] =
            static_cast<float>(fraction(changes * loop_fraction(facts)));
    }
    block.bump_kind = {contraction, 0, 0, 0};
    if (facts.surface != Surface::coast) return;
    // Foam forms on crests at wind speeds above 5 m/s and reaches its maximum at 15 m/s.
    const double foam = std::clamp((sea.wind_speed_mps - 5) / 10, 0., 1.);
    const double warp = 0.9;  // metres along the wind per metre of height
    block.bump_kind = {contraction, foam, -warp * std::cos(sea.wind_direction_rad),
                       -warp * std::sin(sea.wind_direction_rad)};
    block.waves.x = 4 * static_cast<float>(0.21 * first_slope * kind.largest_m * 1.2);
}

void place_pond(SceneBlock& block, const SeaFacts& facts, glm::dvec2 viewer) {
    const SeaState& sea = facts.sea;
    const std::vector<PondOctave> octaves = octaves_of(PondSea{.direction_rad = sea.wind_direction_rad});
    assert(octaves.size() == block.pond_wave.size());
    double slopes = 0, squares = 0;  // mean square slope, sum of squared heights
    for (const PondOctave& octave : octaves) {
        slopes += pond_slope_variance * std::pow(2 * pi * octave.turns_per_m() * octave.height_m, 2.);
        squares += octave.height_m * octave.height_m;
    }
    const double scale = std::sqrt(0.5 * mean_square_slope(sea.wind_speed_mps) / slopes);
    for (std::size_t i = 0; i < octaves.size(); ++i) {
        const PondOctave& octave = octaves[i];
        const double turns = octave.turns_per_m_x * viewer.x + octave.turns_per_m_z * viewer.y -
                             std::round(octave.frequency_hz * sea.loop_period_s) * loop_fraction(facts) +
                             octave.phase_turns;
        block.pond_wave[i] = {2 * pi * octave.turns_per_m_x, 2 * pi * octave.turns_per_m_z, scale * octave.height_m,
                              2 * pi * fraction(turns)};
    }
    block.bump_kind = {1, octaves[0].drag_m / (scale * octaves[0].height_m), 0, 0};
    block.waves.x = static_cast<float>(4 * scale * std::sqrt(pond_variance * squares));
}

void place_flow(SceneBlock& block, const SeaFacts& facts, glm::dvec2 viewer) {
    const FlowExtent& flow = facts.flow;
    constexpr double cycle_s = 2.5;
    const double count = std::max(1., std::round(facts.sea.loop_period_s / cycle_s));
    const double cycle = count * loop_fraction(facts);
    const auto jump = [&](double of) {
        const double number = std::fmod(std::floor(of), count);
        // The R2 sequence (Roberts 2018).
        return glm::dvec2(fraction(number * 0.7548777), fraction(number * 0.5698403)) * 19.;
    };
    const glm::dvec2 first = jump(cycle), second = jump(cycle + 0.5) + 7.3;
    block.flow_place = {fraction(viewer.x / flow.side_m), fraction(viewer.y / flow.side_m), 1 / flow.side_m, 0};
    block.flow_cycle = {fraction(cycle), fraction(cycle + 0.5), flow.fastest_mps * facts.sea.loop_period_s / count,
                        0};
    block.flow_jump = {first.x, first.y, second.x, second.y};
}

}  // namespace

std::string check(const FlowMap& map) {
    if (map.side < 1 || map.side > 4096) return invalid_value_message("side", map.side, "1 to 4096");
    if (!(map.extent.side_m > 0)) return invalid_value_message("side_m", map.extent.side_m, "a length above 0");
    if (!(map.extent.fastest_mps > 0))
        return invalid_value_message("fastest_mps", map.extent.fastest_mps, "a speed above 0");
    const std::size_t bytes = std::size_t{2} * map.side * map.side;
    if (map.velocities.size() != bytes)
        return "velocities has " + std::to_string(map.velocities.size()) +
               " bytes, expected 2 side^2 = " + std::to_string(bytes);
    return {};
}

FlowMap winding_channel() {
    FlowMap map{.extent = {}, .side = 256, .velocities = {}};
    const double width = 0.16, swing = 0.14;  // fractions of the side
    for (int j = 0; j < map.side; ++j)
        for (int i = 0; i < map.side; ++i) {
            const double x = (i + 0.5) / map.side, z = (j + 0.5) / map.side;
            const double bend = 2 * pi * x, slope = swing * 2 * pi * std::cos(bend);
            // Distance from the centre line of the channel; bends shift the fastest water outwards.
            const double length = std::hypot(1, slope);
            const double across = (z - 0.5 - swing * std::sin(bend)) / length / width - 0.25 * std::sin(bend);
            const double speed = std::max(0., 1 - across * across);
            map.velocities.push_back(static_cast<std::uint8_t>(128 + std::lround(127 * speed / length)));
            map.velocities.push_back(static_cast<std::uint8_t>(128 + std::lround(127 * speed * slope / length)));
        }
    return map;
}

void place_small_water(SceneBlock& block, const SeaFacts& facts, glm::dvec2 in_water, glm::dvec2 viewer) {
    if (facts.surface == Surface::pond)
        place_pond(block, facts, in_water);
    else
        place_octaves(block, facts, in_water);
    if (facts.surface == Surface::river) place_flow(block, facts, viewer);
}

}  // namespace pelagic::gl
