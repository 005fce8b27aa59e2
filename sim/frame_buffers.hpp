// A frame as plain arrays of the application's own, for whoever keeps frames: servers, replays, files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "pelagic/sim/frame.hpp"

namespace pelagic {

/// Where to write one cascade. Each span is as long as stated, N being the cascade's resolution, or empty if nobody wants it. Rows are
/// tight, texel (i, j) at j N + i. None aliases another or the frame.
struct FrameBuffers {
    std::span<float> dx = {}, height = {}, dz = {};                      ///< N^2, metres
    std::span<float> velocity_x = {}, velocity_y = {}, velocity_z = {};  ///< N^2, metres a second
    std::span<std::uint16_t> displacement_rgba16f = {};                  ///< 4 N^2
    std::span<std::uint32_t> gradient_rgba8 = {};                        ///< mip_offset(N, mip_levels(N))
    std::span<std::uint32_t> slopes_rgba8 = {}, moments_rgba8 = {};      ///< the same
    std::span<std::uint8_t> foam_r8 = {};                                ///< the same, a byte a texel
};

/// Which parts frames have that not every frame has.
struct FrameContents {
    bool velocities = false, gradients = true, slopes = false, foam = false;
};

/// Empty if frames of so many cascades of this resolution can be written there, else what is bad first: "height has 100 elements,
/// needs 4096", "velocity_x is wanted, needs an ocean with velocities", "there are buffers of 2 cascades, needs 3".
std::string check(std::span<const FrameBuffers> cascades, std::size_t cascade_count, int resolution,
                  const FrameContents& contents);

/// Writes a plane, whatever blocks it is stored in, as tight rows: texel (i, j) at j N + i. `out` has N^2 elements, or none
/// if nobody wants it; else std::invalid_argument. For the planes of a frame; one without data has no rows to write.
void copy_plane(const PlaneView& plane, std::span<float> out);

/// One for each cascade of the frame. Throws std::invalid_argument(check(...)) before it writes.
void copy_frame(const Frame& frame, std::span<const FrameBuffers> cascades);
inline void copy_frame(const Frame& frame, const FrameBuffers& only_cascade) {
    copy_frame(frame, {&only_cascade, 1});
}

}  // namespace pelagic
