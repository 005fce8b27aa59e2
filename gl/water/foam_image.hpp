// Foam's structure at three scales, made once: bubbles, lace and streaks down the wind. A shader gets from it where foam lies
// when so much of the water is under it; how much that is, the waves say (gl/shaders/foam.glsl).
#pragma once

#include <cstdint>
#include <vector>

#include "pelagic/jobs/executor.hpp"

namespace pelagic::gl {

/// Layers of a texture that repeats. Bytes of a texel:
///
///   bubbles   rank; slopes of the bubbles' caps along x and y; height of the caps
///   lace      rank; slopes of the threads along x and y; height of the froth on them
///   streaks   rank; two numbers that bend what is smaller; broad patches
///
/// A rank is the part of the layer that lies lower: above the threshold 1 - a lies the part a of it, at every level, so foam
/// covers as much from near and far. Slopes and bends are signed, 128 is zero.
struct FoamImage {
    enum Layer { bubbles, lace, streaks };
    static constexpr int side = 256, layers = 3, levels = 9;

    /// RGBA8, level by level, in them layer by layer, tight rows. x of streaks runs down the wind.
    std::vector<std::uint8_t> texels;

    const std::uint8_t* level(int level) const;
    const std::uint8_t* texel(int level, Layer layer, int x, int y) const;
};

/// How large the layers are at sea, metres. Bubbles of 1 to 5 cm and lace with holes of 1 dm to 1 m are the same in every sea.
/// Streaks are windrows, where Langmuir's circulation gathers foam: 2 to 20 m apart and many times as long (Leibovich
/// 1983, "The Form and Dynamics of Langmuir Circulations"). The second size of streaks is for the far sea.
struct FoamSizes {
    static constexpr double bubbles_m = 0.83, lace_m = 5.3;
    static constexpr double streaks_along_m[2] = {262, 1411}, streaks_across_m[2] = {61, 353};
};

/// Bakes it with jobs and waits for them. Always the same bytes on one machine, whatever the executor.
FoamImage make_foam_image(Executor& executor);

}  // namespace pelagic::gl
