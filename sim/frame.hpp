// What a frame yields, as views into the ocean that made it.
#pragma once

#include <cstdint>
#include <span>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/dynamic_waves_view.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/shore_surface.hpp"
#include "pelagic/sim/slope_variance.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic {

/// What holds for all frames of a sea, found out when its spectrum is baked.
struct SeaStatistics {
    /// 4 sqrt(variance), mean over all seeds, of the waves that the cascades hold; as expected_waves() has it.
    double significant_wave_height_m = 0;
    /// Mean squares of the slopes that the cascades' textures show at their finest level, mean over all seeds; and what is left
    /// of those that were measured in such a wind (Cox and Munk 1954, spectrum/mean_square_slope.hpp).
    SlopeVariance resolved_slopes, unresolved_slopes;
    /// What the smoothness channel says of the water between texels, 1 - sqrt(roughness): SeaState::roughness, or what the wind
    /// and the unresolved slopes make of it.
    double roughness = 0;
    /// How fast foam drifts over the sea, m/s: with the wind and with the waves (Stokes' drift), in the world's axes.
    double foam_drift_x_mps = 0, foam_drift_z_mps = 0;
};

/// One frame, which says what it is: whoever draws it or asks it needs nothing else about the sea.
/// The point of water that has the reference position (x, z) is drawn at (x + Dx, height, z + Dz), each the sum of what the cascades hold there.
/// Views stay valid until the ocean schedules the second frame after this one.
struct Frame {
    double time_s = 0;
    SeaState sea;
    SeaStatistics statistics;
    Isa isa = {};                       ///< that computed it
    std::span<const Cascade> cascades;  ///< at least one; the coarsest first
    /// Sums of the cascades' bounds: exact for one cascade, upper bounds for several, whose extremes need not meet.
    FrameBounds bounds;
    /// What adds to the cascades where applications move the water, with OceanOptions::dynamic_waves; within the bounds, too.
    DynamicWavesView dynamic_waves;
    /// Where the sea has a floor that waves feel, with OceanOptions::shore; within the bounds, too.
    ShoreSurface shore;
};

/// XXH3 of every output of the frame: of each cascade the rows of dx, height and dz, the half floats but for foam, the gradient chain (of
/// several cascades the two chains of slopes instead) and the bounds, in this order, little-endian. The time is not in it, nor are
/// velocities, folds and whichever chains only OceanOptions asked for: whoever wants them has the same sea as one who doesn't.
/// Textures that were written into memory of the application's (texture_targets.hpp) are not in it either. Two frames with equal hashes hold the same bits.
std::uint64_t hash_of(const Frame& frame);

/// The same of the cascades' chains of foam, which belong to the sea and the time as everything else does, and are asked for by
/// OceanOptions::foam.
std::uint64_t foam_hash_of(const Frame& frame);

}  // namespace pelagic
