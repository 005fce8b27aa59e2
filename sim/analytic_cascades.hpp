// Analytic waves and procedural pond waves (SeaState::waves analytic and pond): as the options
// define them, and as the cascades of a frame hold them.
//
//   const AnalyticSurface water(waves_of_cascades(sea));  // equals ocean.frame_at(t)
//
// The surface is that of the frame, also between texels.
//
// A cascade holds only waves of its grid, with whole numbers of periods in a loop. Each wave moves
// to the nearest grid point of the cascade in whose band it is, and keeps amplitude and phase. On
// the default cascades that changes a wavelength by 2 %, at most 7 %, and a direction by three
// degrees at most. The frequency is that of the moved wave in deep water, rounded to a whole number
// of periods in a loop.
#pragma once

#include <vector>

#include "pelagic/analytic/plane_waves.hpp"
#include "pelagic/analytic/pond_waves.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

/// Returns the waves of the options, before they move to grid points.
/// \pre check(sea) is empty and sea.waves is analytic
AnalyticSea analytic_sea_of(const SeaState& sea);

/// Returns the waves that the cascades hold. Heights and horizontal displacements at texels are
/// those of the frame within 1e-6 of the sum of the amplitudes. Waves of less than two texels of
/// the finest cascade (three, in a stack) are left out. \pre check(sea) is empty and sea.waves is
/// analytic
PlaneWaves waves_of_cascades(const SeaState& sea);

/// Returns the octaves of the options, before they move to grid points.
/// \pre check(sea) is empty and sea.waves is pond
PondSea pond_sea_of(const SeaState& sea);

/// Returns the octaves that the cascade holds. The cascade samples them with a footprint of a
/// texel; the slopes that this removes are part of the frame's roughness.
/// \pre check(sea) is empty and sea.waves is pond
std::vector<PondOctave> octaves_of_cascade(const SeaState& sea);

}  // namespace pelagic
