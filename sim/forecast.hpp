// Forecast: sea states with times, and the transitions between them.
//
//   Forecast forecast{.first = calm};
//   forecast.changes.push_back({.sea = storm, .from_s = 60, .over_s = 20});
//   Ocean ocean(forecast);
//
// Each wave of the grid keeps its random numbers, and its energy changes from one sea to the next:
//
//   E = (1 - s) E0 + s E1,  s = u^2 (3 - 2u),  u = (t - from) / over in [0, 1]
//
// An amplitude is the square root of its energy. With a linear weight the amplitude of a wave that
// starts from zero would start with an infinite slope.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

/// A sea-state transition.
struct SeaChange {
    SeaState sea;       ///< the sea after the transition
    double from_s = 0;  ///< start
    double over_s = 0;  ///< duration; (0, 1e9]
    /// Distance to the origin of the swell, whose waves are all raised there at one moment; [1e3,
    /// 2e7]. Unset: all waves change together. The sea must have a swell or systems, of which the longest
    /// peak period is that of the swell. Long waves arrive first,
    /// by their group velocities cg = d omega / d k, and each changes over over_s:
    ///
    ///   begin(omega) = from_s + swell_from_m (1 / cg(omega) - 1 / cg(omega of 1.5 swell periods))
    ///
    /// Waves longer than 1.5 peak periods of the swell begin with the waves of that period. Waves
    /// shorter than a third of the peak period also begin with the waves of that period. Waves of
    /// one of the loop's frequencies begin together; from its 32nd harmonic on, those of one of
    /// sixteen bands an octave.
    std::optional<double> swell_from_m = {};

    /// Returns the time at which the last waves have changed.
    double end_s() const;
};

/// The state of a forecast at a time: two seas and the weight of the second.
struct ForecastMoment {
    std::size_t before = 0, after = 0;  ///< as in Forecast::sea()
    /// s, the weight of the sea `after`, 0 to 1; 0 if both are one sea. Of a swell with
    /// swell_from_m, the weight of the waves at its peak.
    double weight = 0;
};

/// A sea and its transitions, as a value: a frame is a function of the forecast and the time,
/// independent of earlier frames. The first sea determines the kind of cascades, their number,
/// resolution and side, depth, loop period and seed.
struct Forecast {
    SeaState first;
    /// In order of time; each begins after the preceding one has ended.
    std::vector<SeaChange> changes = {};
    /// Longest peak wavelength that the cascades can hold, which limits seas that are scheduled
    /// later; (0, 1e5]. Unset: the longest of these seas. Ignored if patch_size_m is set.
    std::optional<double> largest_peak_m = {};

    /// Returns the first sea for 0, and that of changes[i - 1] for i. \pre number <= changes.size()
    const SeaState& sea(std::size_t number) const { return number == 0 ? first : changes[number - 1].sea; }
    /// Returns the sea after all changes.
    const SeaState& last() const { return sea(changes.size()); }
    /// Returns the state at a time. \pre check() is empty, and time_s is finite
    ForecastMoment at(double time_s) const;
};

/// Gives a sea the values of `first` in the fields that a forecast keeps constant, where the sea
/// has their defaults: cascades, resolution, patch size, depth, loop period and seed.
void keep_constant_fields(SeaState& sea, const SeaState& first);

/// Returns an empty string for a usable forecast, else a message about the first invalid value:
/// "change 1: depth_m is 20, expected 4000 as the first sea has it". Messages about a sea begin
/// with the number of that sea.
std::string check(const Forecast& forecast);

/// Returns the range of waves of the cascades that all seas share. \pre check(forecast) is empty
WaveReach reach_of(const Forecast& forecast);
/// Returns that range from own_reaches(forecast), which searches each spectrum for about a
/// millisecond.
/// \pre check(forecast) is empty
WaveReach reach_of(const Forecast& forecast, std::span<const WaveReach> own);
/// Returns the range of waves of each sea. \pre check(forecast) is empty
std::vector<WaveReach> own_reaches(const Forecast& forecast);
/// Returns the shared cascades with the bands of the first sea. \pre check(forecast) is empty
std::vector<CascadePlan> plan_cascades(const Forecast& forecast);

/// Returns the sea state that a frame reports during a transition.
///
/// Numbers are interpolated with `weight`, heights of swell by their energy. Directions
/// rotate through the smaller angle (for a half turn from +x towards +z). Models and systems are
/// those of the sea with the larger weight. Values that only one of the seas has, such as a swell's period and
/// direction or a given roughness, are taken from that sea. The waves themselves are the blend of
/// both seas' energies, whose statistics are in SeaStatistics. \pre weight in [0, 1]
SeaState sea_between(const SeaState& before, const SeaState& after, double weight);

}  // namespace pelagic
