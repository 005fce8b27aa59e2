// The outputs of a peer's frame, which are compared with Pelagic's before frames are timed.
#pragma once

#include <cstdint>
#include <span>

namespace pelagic::peers {

/// Outputs of a peer's frame: views into the peer, row-major without gaps. They correspond to
/// pelagic::Frame.
struct PeerFrame {
    std::span<const float> dx, height, dz;   ///< N * N each, metres
    std::span<const std::uint16_t> rgba16f;  ///< 4 * N * N half floats: Dx, height, Dz, 0
    /// the whole gradient chain, level m at mip_offset(N, m) of sim/frame.hpp
    std::span<const std::uint32_t> rgba8;
};

}  // namespace pelagic::peers
