// Seas of few waves (SeaState::waves analytic and pond) as they are asked for, and as the cascades of a frame hold them:
//
//   const AnalyticSurface water(waves_of_cascades(sea));  // the water of ocean.frame_at(t), between its texels too
//
// A cascade holds waves of its grid alone, with whole periods in a loop. Each wave goes to the nearest place of the
// grid of the cascade whose band it is in, and keeps amplitude and phase: on the default cascades that changes a length by
// 2 %, at most 7, and turns a wave by three degrees at most. A frequency is that of the new wave, in deep water, but
// with as many periods in a loop as is nearest.
#pragma once

#include <vector>

#include "pelagic/analytic/plane_waves.hpp"
#include "pelagic/analytic/pond_waves.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

/// Before its waves are moved. \pre check(sea) is empty and sea.waves is analytic
AnalyticSea analytic_sea_of(const SeaState& sea);

/// As the cascades hold it: heights and horizontal displacements at texels are those of the frame within 1e-6 of the sum of the
/// amplitudes. Waves of less than two texels of the finest cascade (three, in a stack) are left out. \pre the same
PlaneWaves waves_of_cascades(const SeaState& sea);

/// Before its octaves are moved. \pre check(sea) is empty and sea.waves is pond
PondSea pond_sea_of(const SeaState& sea);

/// As its cascade holds them. The cascade shows them with a footprint of a texel: what that hides of their slopes is the frame's
/// roughness. \pre the same
std::vector<PondOctave> octaves_of_cascade(const SeaState& sea);

}  // namespace pelagic
