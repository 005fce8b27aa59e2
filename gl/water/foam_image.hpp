// Texture of foam structure at three scales: bubbles, lace and wind-aligned streaks. Shaders
// compare it with the foam coverage that the waves give, to decide which points of the water are
// covered (gl/shaders/foam.glsl).
#pragma once

#include <cstdint>
#include <vector>

#include "pelagic/jobs/executor.hpp"

namespace pelagic::gl {

/// Periodic array texture. Bytes of a texel in each layer:
///
///   bubbles   rank; slopes of the bubbles' caps along x and y; score
///   lace      rank; slopes of the sheet along x and y; score
///   streaks   rank; offset along x and y that distorts the finer layers; score
///
/// The rank of a texel is the fraction of the layer that is lower. At every mip level the fraction
/// a of the texels exceeds the threshold 1 - a, so coverage does not depend on distance. The score
/// is the standard normal variable of that rank, so that the scores of several samples add.
/// Slopes, offsets and scores are signed bytes with 128 as zero.
struct FoamImage {
    enum Layer { bubbles, lace, streaks };
    static constexpr int side = 256, layers = 3, levels = 9;
    static constexpr float largest_score = 3.2f;  ///< of the byte 255

    /// RGBA8, ordered by level, then layer, rows without padding. The x axis of streaks points
    /// downwind.
    std::vector<std::uint8_t> texels;

    const std::uint8_t* level(int level) const;
    const std::uint8_t* texel(int level, Layer layer, int x, int y) const;
};

/// Periods of the layers in metres. Bubbles measure 2 to 7 mm in every sea. Lace is sampled at up
/// to three scales (gl/shaders/foam.glsl), of which the widest has this period: holes measure 1 cm to
/// 4 m. Streaks are windrows, in which Langmuir circulation gathers foam: 2 to 20 m apart and many
/// times as long (Leibovich 1983, "The Form and Dynamics of Langmuir Circulations"). The second
/// size of streaks is used far from the viewer.
struct FoamSizes {
    static constexpr double bubbles_m = 0.14, lace_m = 17;
    static constexpr double streaks_along_m[2] = {262, 1411}, streaks_across_m[2] = {61, 353};
};

/// Generates the image with jobs and waits for them. On one machine the bytes are identical for
/// every executor.
FoamImage make_foam_image(Executor& executor);

}  // namespace pelagic::gl
