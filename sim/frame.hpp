// A frame: views of cascades, dynamic waves, a shore and spray, which the ocean owns.
#pragma once

#include <array>
#include <cstdint>
#include <span>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/dynamic_waves_view.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/shore_surface.hpp"
#include "pelagic/sim/slope_variance.hpp"
#include "pelagic/sim/snapshot_foam.hpp"
#include "pelagic/sim/spray.hpp"
#include "pelagic/sim/water_frame.hpp"
#include "pelagic/simd/isa.hpp"

namespace pelagic {

/// Statistics that are constant for all frames of a sea.
struct SeaStatistics {
    /// 4 sqrt(variance) of the waves that the cascades hold, mean over all seeds, as in
    /// expected_waves().
    double significant_wave_height_m = 0;
    /// Mean squares of the slopes that the cascades' textures hold at their finest level, mean over
    /// all seeds. The unresolved ones are the remainder of those measured in such a wind (Cox and
    /// Munk 1954, spectrum/mean_square_slope.hpp).
    SlopeVariance resolved_slopes, unresolved_slopes;
    /// GGX roughness of unresolved waves, SeaState::roughness or derived from the wind and the
    /// unresolved slopes. The smoothness channel is 1 - sqrt(roughness).
    double roughness = 0;
    /// Drift velocity of foam in the world's axes, m/s: by the wind and by the waves (Stokes'
    /// drift).
    double foam_drift_x_mps = 0, foam_drift_z_mps = 0;
    /// Factors of h_x and h_z in the compression (snapshot_foam.hpp), in proportion to the choppiness.
    double foam_front_x = 0, foam_front_z = 0;
    /// Standard deviation of the weighted compression of all cascades (snapshot_foam.hpp), and the
    /// number of deviations at which half of the water is white. The level is no_foam_level if the
    /// sea has no whitecaps.
    double compression_deviation = 0, foam_level = no_foam_level;
    static constexpr double no_foam_level = 1000;
    std::array<FoamFilter, FoamFilter::widths> foam_filters;
};

/// One frame, with all data about the sea that rendering and queries need.
///
/// Water with the undisplaced position (x, z) is drawn at (x + Dx, height, z + Dz), where each term
/// is the sum over the cascades there. Views stay valid until the ocean schedules the second frame
/// after this one.
struct Frame {
    double time_s = 0;
    SeaState sea;
    bool sea_changes = false;  ///< whether the time lies in a transition between two seas of a forecast
    SeaStatistics statistics;
    Isa isa = {};                       ///< the instruction set that computed the frame
    std::span<const Cascade> cascades;  ///< at least one; the coarsest first
    /// Sums of the cascades' bounds: exact for one cascade, upper bounds for several, whose
    /// extremes need not coincide.
    FrameBounds bounds;
    /// Waves to add to the cascades, with OceanOptions::dynamic_waves; the bounds include them.
    DynamicWavesView dynamic_waves;
    /// Waves over a sea floor, with OceanOptions::shore; the bounds include them.
    ShoreSurface shore;
    /// Whether the cascades have foam (OceanOptions::foam), and how their compression makes it.
    bool has_foam = false;
    SnapshotFoam foam;
    /// Spray, with OceanOptions::spray: at most 8192 droplets in the world, first those of emitters,
    /// then those of crests, each with the newest first. Droplets below the water are not removed.
    std::span<const SprayDroplet> droplets;
    /// Position of the water in the world, as of Ocean::set_water_frame(). All other members but
    /// droplets are in the water's frame, `bounds` included.
    WaterFrame water_frame;
};

/// Returns the XXH3 of the frame's outputs. Two frames with equal hashes are bit-identical.
///
/// The hash covers these outputs of each cascade, in this order and little-endian: the rows of dx,
/// height and dz; the half floats; the chains that OceanOptions enables by default without foam; the
/// bounds. It leaves out time and water frame, and all other outputs, so an ocean with more outputs
/// has equal hashes. It also leaves out textures in the application's memory (texture_targets.hpp),
/// and planes and textures that the frame does not have.
std::uint64_t hash_of(const Frame& frame);

/// Returns the XXH3 of the cascades' foam, which OceanOptions::foam enables: of each cascade the
/// bytes of compression and the chains of snapshots, in this order, without those that the frame
/// does not have, then the drift and the scale; last the level and the ages of
/// Frame::foam. Foam is a function of the sea and the time, as all outputs are.
std::uint64_t foam_hash_of(const Frame& frame);

/// Returns the XXH3 of the droplets' members, little-endian and in their order. Without emitters and
/// without a current it is a function of the sea, the time in the loop and the centre.
std::uint64_t spray_hash_of(const Frame& frame);

}  // namespace pelagic
