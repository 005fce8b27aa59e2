// The listed waves of analytic seas, ponds and regular seas, on the grids of their cascades.
#pragma once

#include <complex>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "pelagic/sim/analytic_cascades.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/slope_variance.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"

namespace pelagic {

/// Water whose depth affects no wave.
inline constexpr Water deep_water(1e7);

/// The wave vector (2 pi / L)(m, n) of a cascade.
struct GridIndex {
    int m = 0, n = 0;

    bool operator==(const GridIndex&) const = default;
    double steps() const;  ///< length of the wave vector, in units of 2 pi / L
};

/// Returns the grid index nearest to a wave vector. \param turns_per_m_x, turns_per_m_z  along the
/// world's axes
GridIndex nearest_place(const CascadeGrid& grid, double turns_per_m_x, double turns_per_m_z);
/// Returns the wave vector of a grid index, in turns per metre along the world's axes.
CascadeGrid::Vector turns_per_m_of(const CascadeGrid& grid, const GridIndex& at);

/// The wave of a regular sea, and its bound second harmonic, with a crest at (0, 0) at t = 0:
///
///   h = level + a cos(phase) + b cos(2 phase)
///   b + choppiness c(2 k) k b^2 = k a^2 (3 - t^2) / (4 t^3) - choppiness c(k) k a^2 / 2
///
/// with t = tanh(k d) and c(k) = orbit_ratio(k, d). The first term is the harmonic of the height at a
/// fixed place (Stokes 1847). The second is what the displacement of the wave makes of it there, and
/// the term in b^2 is the harmonic's part of the level. b is 0 at order 1.
struct StokesWave {
    double k;            ///< rad/m
    double omega;        ///< rad/s
    double amplitude_m;  ///< a
    double harmonic_m;   ///< b
};
/// \pre all fields are in their ranges
StokesWave stokes_wave_of(const SeaState& sea);
/// Returns the number of wavelengths along the side of a regular sea's cascade. \pre as above
int regular_waves_per_side(const SeaState& sea);

/// A wave of an analytic or regular sea on a cascade's grid.
struct GridWave {
    GridIndex at;
    double amplitude_m, phase_turns;

    /// h0: h = 2 Re h0 e^{i (k.x - w t)}
    std::complex<double> half_amplitude() const;
};

/// Returns the waves of a cascade. Several waves may have one grid index.
/// \pre check(sea) is empty, sea.waves is analytic or regular, and `cascade` is one of
/// plan_cascades(sea)
std::vector<GridWave> grid_waves(const SeaState& sea, const CascadePlan& cascade);

/// An octave of a pond on its cascade's grid.
struct GridOctave {
    GridIndex at;
    std::uint32_t harmonic;  ///< periods in a loop
    PondOctave octave;       ///< with the wave vector and frequency of the grid
    double shown;            ///< fraction of the amplitude that texels can show, [0, 1]

    /// Returns the mean square of the shown height, m^2.
    double height_variance() const;
    /// Returns the mean square of the whole slope.
    double slope_variance() const;
};

/// Returns the octaves of a pond on its cascade's grid.
/// \pre check(sea) is empty, sea.waves is pond, and `cascade` is that of plan_cascades(sea)
std::vector<GridOctave> grid_octaves(const SeaState& sea, const CascadePlan& cascade);

/// Returns the mean square slope of a pond's octaves that texels cannot show, along the wind and
/// across it.
SlopeVariance hidden_slopes(const SeaState& sea, std::span<const GridOctave> octaves);

/// Returns the longest wave of a sea, m. \pre sea.waves is not spectrum
double longest_wave_of(const SeaState& sea);
/// Returns the shortest wave of a sea, m. \pre sea.waves is not spectrum
double shortest_wave_of(const SeaState& sea);

/// Returns the default side of a pond's cascade, m.
double pond_side_m(const SeaState& sea);

/// Returns an empty string if the sea is valid, else one line that describes the first error.
/// \pre sea.waves is not spectrum, and all fields are in their ranges
std::string check_wave_list(const SeaState& sea);

}  // namespace pelagic
