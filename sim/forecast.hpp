// Seas with times: which sea there is when, and how one turns into the next.
//
//   Forecast forecast{.first = calm};
//   forecast.changes.push_back({.sea = storm, .from_s = 60, .over_s = 20});
//   Ocean ocean(forecast);
//
// Each wave of the grid keeps its draw, and its energy goes over from one sea to the next:
//
//   E = (1 - s) E0 + s E1,  s = u^2 (3 - 2u),  u = (t - from) / over in [0, 1]
//
// An amplitude is a root of its energy. With a linear weight one that starts from nothing would start with an infinite slope.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

/// The sea turns into another one.
struct SeaChange {
    SeaState sea;       ///< that there is afterwards
    double from_s = 0;  ///< when it begins
    double over_s = 0;  ///< how long it takes; (0, 1e9]
    /// The waves of its swell were raised so far away, all at one moment: 0, all waves change together, or [1e3, 2e7]. Long ones
    /// come first, each within over_s of its own, by their group velocities d omega / d k:
    ///
    ///   begin(omega) = from_s + swell_from_m (1 / cg(omega) - 1 / cg(omega of 1.5 swell periods))
    ///
    /// Waves longer than 1.5 periods of the swell's peak come with those, shorter than a third with those. Waves of one of the
    /// loop's frequencies come together, from its 32nd harmonic on sixteen bands an octave. The sea has a swell.
    double swell_from_m = 0;

    /// When the last waves have come.
    double end_s() const;
};

/// What the weather is at a moment: two seas of a forecast, and how much there is of the second.
struct ForecastMoment {
    std::size_t before = 0, after = 0;  ///< as Forecast::sea() counts
    /// s, of the sea after; 0 where it is one sea, before and after. Of a swell from afar that of the waves at its peak, 0 to 1.
    double part = 0;
};

/// A value: a frame is a function of the forecast and the time, whatever frames there were before.
/// The kind of cascades, their number, resolution and side, depth, loop period and seed are those of the first sea.
struct Forecast {
    SeaState first;
    std::vector<SeaChange> changes = {};  ///< in order: none begins before the one before it is over
    /// Cascades are laid out for waves with peaks up to this long; 0: the longest peak of these seas, or (0, 1e5]. A sea that is
    /// scheduled later may have no longer one. Without meaning where the side of the cascade is given.
    double largest_peak_m = 0;

    /// 0 is the first, i is that of changes[i - 1]. \pre number <= changes.size()
    const SeaState& sea(std::size_t number) const { return number == 0 ? first : changes[number - 1].sea; }
    const SeaState& last() const { return sea(changes.size()); }
    /// \pre check() is empty, and the time finite
    ForecastMoment at(double time_s) const;
};

/// Empty if usable, else the first thing that is not: "depth_m of change 1 is 20, needs 4000 as the first sea has it". What
/// check() says of a sea begins with which one it is.
std::string check(const Forecast& forecast);

/// How far the cascades that all of its seas share reach, and those cascades, with the bands that the first has in them.
/// \pre check(forecast) is empty
WaveReach reach_of(const Forecast& forecast);
/// The same where the reach of each of its seas is known: own_reaches(), which searches each spectrum for about a millisecond.
WaveReach reach_of(const Forecast& forecast, std::span<const WaveReach> own);
std::vector<WaveReach> own_reaches(const Forecast& forecast);
std::vector<CascadePlan> plan_cascades(const Forecast& forecast);

/// What a frame in between says that its sea is: numbers go over with `part`; heights of swell as their energy does; directions
/// turn the shorter way (a half turn: the way from +x towards +z); models are those of the sea that there is more of. What only
/// one of them has, a swell's period and direction, a roughness that is given, is that one's. The waves themselves are the blend
/// of both seas' energies, whose figures a frame has in SeaStatistics. \pre part in [0, 1]
SeaState sea_between(const SeaState& before, const SeaState& after, double part);

}  // namespace pelagic
