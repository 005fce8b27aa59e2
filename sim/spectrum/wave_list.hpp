// The waves of a sea that has no spectrum, but a list of them, on the grids of its cascades.
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

/// Deeper than any wave feels.
inline constexpr Water deep_water(1e7);

/// The wave vector (2 pi / L)(m, n) of a cascade.
struct GridIndex {
    int m = 0, n = 0;

    bool operator==(const GridIndex&) const = default;
    double steps() const;  ///< its length, in 2 pi / L
};

/// The one nearest to a wave vector, which is given by its turns a metre along the world's axes; and the other way round.
GridIndex nearest_place(const CascadeGrid& grid, double turns_per_m_x, double turns_per_m_z);
CascadeGrid::Place turns_per_m_of(const CascadeGrid& grid, const GridIndex& at);

/// A wave of an analytic sea on a cascade's grid.
struct GridWave {
    GridIndex at;
    double amplitude_m, phase_turns;

    /// h0: h = 2 Re h0 e^{i (k.x - w t)}
    std::complex<double> half_amplitude() const;
};

/// The waves of one of plan_cascades(sea). Two may be at one place. \pre check(sea) is empty and sea.waves is analytic
std::vector<GridWave> grid_waves(const SeaState& sea, const CascadePlan& cascade);

/// An octave of a pond on its cascade's grid.
struct GridOctave {
    GridIndex at;
    std::uint32_t harmonic;  ///< periods in a loop
    PondOctave octave;       ///< as moved there
    double shown;            ///< what of it texels can show; the rest is hidden

    /// Mean squares of what is shown of its height, m^2, and of all its slope.
    double height_variance() const;
    double slope_variance() const;
};

/// \pre check(sea) is empty, sea.waves is pond, and `cascade` is that of plan_cascades(sea)
std::vector<GridOctave> grid_octaves(const SeaState& sea, const CascadePlan& cascade);

/// Mean square slope of what the cascade's texels hide of a pond's octaves, along the wind and across it.
SlopeVariance hidden_slopes(const SeaState& sea, std::span<const GridOctave> octaves);

/// Longest and shortest wave that a sea asks for, m. \pre sea.waves is no spectrum
double longest_wave_of(const SeaState& sea);
double shortest_wave_of(const SeaState& sea);

/// The side of a pond's cascade where none is given, m.
double pond_side_m(const SeaState& sea);

/// Empty if such a sea is usable, its fields being in their ranges, else one line. \pre sea.waves is no spectrum
std::string check_wave_list(const SeaState& sea);

}  // namespace pelagic
