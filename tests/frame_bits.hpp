// Hashes of a frame's waves and foam, to compare frames bit by bit.
#pragma once

#include <cstdint>

#include "pelagic/sim/frame.hpp"

namespace pelagic {

struct FrameBits {
    std::uint64_t frame, foam;
    bool operator==(const FrameBits&) const = default;
};
inline FrameBits bits_of(const Frame& frame) { return {hash_of(frame), foam_hash_of(frame)}; }

}  // namespace pelagic
