// Texture of torn spray: opacities of cards, which spray.frag.glsl shows of old droplets.
#pragma once

#include <cstdint>
#include <vector>

namespace pelagic::gl {

/// Each layer is a shred of spray in the square of a card, x along its motion. A byte is the opacity
/// over `scale`; the mean over the square is that of (1 - r^2)^2, pi / 12, and the rim is 0.
struct SprayImage {
    static constexpr int side = 128, layers = 4, levels = 8;
    static constexpr float scale = 2;  ///< spray.frag.glsl has this number too
    /// Ordered by level, then layer, rows without padding.
    std::vector<std::uint8_t> texels;

    const std::uint8_t* level(int level) const;
};

/// Generates the image. The bytes are identical on every call on one machine.
SprayImage make_spray_image();

}  // namespace pelagic::gl
