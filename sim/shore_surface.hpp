// The shore of a frame (shore.hpp).
#pragma once

#include <cstdint>
#include <span>

#include "pelagic/sim/frame_bounds.hpp"

namespace pelagic {

/// A rectangle with a sea floor, in which cascades are attenuated and refracted waves add to them.
/// At a drawn position in the world each cascade is multiplied by its weight there, and the shore's
/// height is added to the sum. Texel (i, j) has the position x = x_m + i texel_m, z = z_m + j
/// texel_m and is element j * columns + i.
///
/// Between texels height_m and vertical_velocity_mps are cubic (Keys 1981, 4 x 4 texels; those of
/// the edge are repeated beyond it); all else is bilinear. Beyond the rectangle the floor continues
/// as at its nearest edge: the depth and the weights are those of the edge, and the height is 0, as
/// on the edge.
struct ShoreSurface {
    int columns = 0, rows = 0;  ///< 0: the ocean has no shore
    double texel_m = 0;
    double x_m = 0, z_m = 0;
    std::span<const float> depth_m;                ///< of still water; below 0 on land
    std::span<const std::uint32_t> weights_rgba8;  ///< weight of cascade t in byte t, 255 for 1
    std::span<const float> height_m;
    std::span<const float> vertical_velocity_mps;
    /// Velocity potential of these waves at the surface: its gradient is their horizontal velocity,
    /// by linear theory.
    std::span<const float> potential_m2ps;
    /// Envelope of the crests of the passing waves, at least height_m. Sand below it is wet.
    std::span<const float> reach_m;
    std::span<const std::uint8_t> foam;  ///< of breaking waves
    FrameBounds bounds;                  ///< of the height, between texels too
    float weights_change_per_m = 0;      ///< largest change of a weight per metre

    /// Returns whether there is a shore.
    explicit operator bool() const { return columns > 0; }
};

}  // namespace pelagic
