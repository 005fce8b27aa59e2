// Copies of a frame in plain arrays of the application, for servers, replays and files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

#include "pelagic/sim/frame.hpp"

namespace pelagic {

/// Arrays that receive a cascade. Each span has the stated length, N being the cascade's
/// resolution, or is empty to leave that array out. Rows are tight: texel (i, j) is element
/// j N + i. No array may overlap another or the frame.
struct FrameBuffers {
    std::span<float> dx = {}, height = {}, dz = {};                      ///< N^2, metres
    std::span<float> velocity_x = {}, velocity_y = {}, velocity_z = {};  ///< N^2, m/s
    std::span<std::uint16_t> displacement_rgba16f = {};                  ///< 4 N^2
    /// mip_offset(N, mip_levels(N))
    std::span<std::uint32_t> gradient_rgba8 = {};
    /// mip_offset(N, mip_levels(N))
    std::span<std::uint32_t> slopes_rgba8 = {}, moments_rgba8 = {};
};

/// Velocities of a frame and of its queries.
enum class Velocities {
    none,
    drawn,  ///< derivatives of the drawn displacement in time, in planes of full resolution
    water   ///< the water's own at the surface, by linear theory, not scaled by choppiness (water_levels.hpp)
};
template <>
struct EnumNames<Velocities> {
    static constexpr std::array<std::string_view, 3> all = {"none", "drawn", "water"};
};

/// Optional contents of each cascade of a frame, as OceanOptions defines them.
struct FrameContents {
    bool queries = false;     ///< fold map or contraction bounds
    Velocities velocities = Velocities::none;
    bool depth = false;       ///< levels below the surface
    bool gradients = true;    ///< gradient_rgba8
    bool slopes = false;      ///< slopes_rgba8 and moments_rgba8
    bool foam = false;        ///< compression_r8 and snapshots_rgba8
    bool planes = true;       ///< dx, height and dz

    /// Returns whether there are velocity_x, velocity_y and velocity_z.
    bool has_drawn_velocities() const { return velocities == Velocities::drawn; }
    /// Returns whether there are water levels: the velocity at the surface at least.
    bool has_water_levels() const { return depth || velocities == Velocities::water; }
};

/// Returns an empty string if the arrays fit frames of `cascade_count` cascades of this resolution,
/// else the first problem: "height has 100 elements, expected 4096", "velocity_x is
/// requested, but the ocean was created without velocities", "there are buffers of 2 cascades, expected 3".
std::string check(std::span<const FrameBuffers> cascades, std::size_t cascade_count, int resolution,
                  const FrameContents& contents);

/// Copies a plane of a frame to tight rows: texel (i, j) is element j N + i. Nothing is written for
/// a plane without data.
/// \throws std::invalid_argument  if `out` has elements, but not N^2
void copy_plane(const PlaneView& plane, std::span<float> out);

/// Computes the compression q of a cascade (snapshot_foam.hpp) without rounding, in tight rows. It
/// adds over cascades exactly, and needs no OceanOptions::foam. The result is 0 for a cascade that
/// makes no foam.
/// \throws std::invalid_argument  if `out` does not have N^2 elements
void copy_compression(const Cascade& cascade, std::span<float> out);

/// Copies a frame, with one FrameBuffers for each cascade.
/// \throws std::invalid_argument  check(...) before it writes, unless it is empty
void copy_frame(const Frame& frame, std::span<const FrameBuffers> cascades);
/// As above, for a frame with 1 cascade.
inline void copy_frame(const Frame& frame, const FrameBuffers& only_cascade) {
    copy_frame(frame, {&only_cascade, 1});
}

}  // namespace pelagic
