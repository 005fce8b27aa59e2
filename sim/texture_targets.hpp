// Where a frame's textures go instead of into the ocean: memory of the application's own, a mapped pixel buffer for instance, which
// spares a copy of them.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "pelagic/sim/frame_buffers.hpp"

namespace pelagic {

/// Of one cascade of N^2 texels. Any map may be left out; it is in the frame then. Each byte is written once, in rows of whole
/// registers, and none is read, so memory may be write-combined. None aliases another or the frame.
struct TextureTargets {
    static constexpr std::size_t alignment = 64, max_levels = 12;
    /// Level m: (N >> m)^2 texels in tight rows, at a multiple of 4 bytes.
    using Chain = std::array<std::uint32_t*, max_levels>;

    std::uint16_t* displacement_rgba16f = nullptr;  ///< 4 N^2 half floats in tight rows, at a multiple of `alignment`
    Chain gradient_rgba8{}, slopes_rgba8{}, moments_rgba8{};  ///< all mip_levels(N), or none
};

/// A chain in one piece, as frames have it: level m at mip_offset(N, m).
TextureTargets::Chain chain_in(std::uint32_t* texels, int resolution);

/// Empty if frames of so many cascades of this resolution can be written there, else what is bad first: "slopes_rgba8 lacks level
/// 3, needs 8 levels", "gradient_rgba8 is wanted, needs an ocean with gradients".
std::string check(std::span<const TextureTargets> cascades, std::size_t cascade_count, int resolution,
                  const FrameContents& contents);

}  // namespace pelagic
