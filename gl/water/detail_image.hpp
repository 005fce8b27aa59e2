// A tile of what is smaller than the sea's texels, made once: ripples, and a noise for gusts.
#pragma once

#include <cstdint>
#include <vector>

namespace pelagic::gl {

/// Channels of a texel: slopes of the ripples along x and z, a noise of ranks, and the part of the ripples' mean square slope
/// that this mip still holds (the rest is roughness). Slopes have a deviation of 1/4 in [-1, 1] at level 0.
struct DetailImage {
    static constexpr int side = 256;
    static constexpr int levels = 9;
    /// RGBA8, level by level, tight rows.
    std::vector<std::uint8_t> texels;

    const std::uint8_t* level(int level) const;
};

/// Always the same bytes on one machine. Ripples run along +x, spread around it, a sum of 96 waves of 3 to 72 cycles a
/// tile; the lace is the distance to the nearest and second nearest of random points (Worley 1996, "A Cellular Texture
/// Basis Function") at four sizes.
DetailImage make_detail_image();

}  // namespace pelagic::gl
