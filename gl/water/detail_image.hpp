// Periodic texture of detail below the texel size of the cascades: ripples, and noise for gusts.
#pragma once

#include <cstdint>
#include <vector>

namespace pelagic::gl {

/// Channels of a texel:
///
///   r, g   slopes of the ripples along x and z, [-1, 1]; standard deviation 1/4 at level 0
///   b      noise, uniformly distributed (rank-transformed)
///   a      fraction of the ripples' mean square slope that this mip resolves;
///          the remainder is roughness
struct DetailImage {
    static constexpr int side = 256;
    static constexpr int levels = 9;
    /// Ripples, cycles per period: the longest and the shortest, and those from which slopes fall
    /// with the wave number.
    static constexpr int longest_ripple = 3, shortest_ripple = 24;
    static constexpr float damped_ripple = 8.5f;
    /// RGBA8, level by level, rows without padding.
    std::vector<std::uint8_t> texels;

    const std::uint8_t* level(int level) const;
};

/// Generates the image. The bytes are identical on every call on one machine.
///
/// The ripples are a sum of 96 waves of 3 to 24 cycles per period, with directions spread around
/// +x. The noise combines the distances to the nearest and second nearest of random points (Worley
/// 1996, "A Cellular Texture Basis Function") at four sizes.
DetailImage make_detail_image();

}  // namespace pelagic::gl
