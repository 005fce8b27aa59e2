// What a frame shows of a shore (shore.hpp).
#pragma once

#include <cstdint>
#include <span>

namespace pelagic {

/// A rectangle of the sea with a floor under it, where cascades are held back and waves that feel the floor add to them. Texel (i, j)
/// stands at x = x_m + i texel_m, z = z_m + j texel_m, in element j * columns + i. Between texels height_m and vertical_velocity_mps are cubic (Keys
/// 1981, the 4 x 4 texels around; those of the edge again beyond it), all else is bilinear. At a place of the world where water is drawn,
/// cascade t counts with its part there, and the shore's height adds to that. Beyond the rectangle the floor continues as its nearest edge
/// has it: the depth and the parts are those of the edge, and the height is 0, as it is on the edge.
struct ShoreSurface {
    int columns = 0, rows = 0;  ///< 0: the ocean has no shore
    double texel_m = 0;
    double x_m = 0, z_m = 0;
    std::span<const float> depth_m;              ///< of still water; below 0 on land
    std::span<const std::uint32_t> parts_rgba8;  ///< of cascade t in byte t from the lowest up, 255 for 1
    std::span<const float> height_m;
    std::span<const float> vertical_velocity_mps;  ///< vertical velocity
    /// Velocity potential of these waves at the surface: its gradient is their horizontal velocity, by linear theory.
    std::span<const float> potential_m2ps;
    /// How high the waves that are passing reach, at least height_m: the envelope of their crests. Sand below it is wet.
    std::span<const float> reach_m;
    std::span<const std::uint8_t> foam;        ///< of waves that break
    float height_min_m = 0, height_max_m = 0;  ///< bounds of the height, between texels too
    float parts_change_per_m = 0;              ///< no part differs by more between places a metre apart

    explicit operator bool() const { return columns > 0; }
};

}  // namespace pelagic
