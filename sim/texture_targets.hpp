// Texture targets: memory of the application, for instance a mapped pixel buffer, to which a frame
// writes its textures instead of to the ocean's memory. That saves a copy.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "pelagic/sim/frame_buffers.hpp"

namespace pelagic {

/// Targets of a cascade of N^2 texels. A map without a target is part of the frame. Each byte is
/// written once, in rows of whole registers, and never read, so the memory may be write-combined.
/// No target may overlap another or the frame.
struct TextureTargets {
    static constexpr std::size_t alignment = 64, max_levels = 12;
    /// Level m: (N >> m)^2 texels in tight rows, at a multiple of 4 bytes.
    using Chain = std::array<std::uint32_t*, max_levels>;

    /// 4 N^2 half floats in tight rows, at a multiple of `alignment`.
    std::uint16_t* displacement_rgba16f = nullptr;
    /// All mip_levels(N) of a chain, or none.
    Chain gradient_rgba8{}, slopes_rgba8{}, moments_rgba8{};
};

/// Returns the levels of a contiguous chain, as in frames: level m at mip_offset(N, m).
TextureTargets::Chain chain_in(std::uint32_t* texels, int resolution);

/// Returns an empty string if the targets fit frames of `cascade_count` cascades of this
/// resolution, else the first problem: "slopes_rgba8 lacks level 3, expected 8 levels",
/// "gradient_rgba8 is requested, but the ocean was created without gradients".
std::string check(std::span<const TextureTargets> cascades, std::size_t cascade_count, int resolution,
                  const FrameContents& contents);

}  // namespace pelagic
