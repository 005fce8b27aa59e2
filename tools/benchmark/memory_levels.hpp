// Copy speed of each level of the memory hierarchy on this machine, beside the bytes that a frame
// moves there.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/tools/benchmark/frame_timing.hpp"

namespace pelagic::tools {

/// A cache, or the memory beyond all caches.
struct MemoryLevel {
    std::string name;       ///< "L1", "L2", ..., or "memory"
    std::size_t bytes = 0;  ///< size of the cache; 0 for memory
    /// Speed of a copy on one thread between buffers that fit into this level only: bytes read,
    /// fetched for writing and written, over time. Maximum of several copies.
    double copy_gb_per_s = 0;
};

/// Measures the copy speed of each level, in half a second. Memory is omitted if no buffers of
/// 512 MiB exceed the last cache. Empty if the system does not report its caches.
std::vector<MemoryLevel> measure_memory_levels();

/// Bytes that a frame moves between a level and the smaller caches.
struct MovedBytes {
    const MemoryLevel* level;
    double bytes;
    double ms;     ///< at the level's copy speed
    double share;  ///< fraction of the measured time of a frame
};

/// Returns the bytes of a frame for each level except the first, from stored counts for a cache as
/// large as the preceding level, or for the next smaller one. Empty if the sea has not been
/// counted.
std::vector<MovedBytes> moved_bytes(const FrameTiming& frame, const std::vector<MemoryLevel>& levels);

/// Prints the levels, and for each sea the bytes and the level that takes longest.
void print_moved_bytes(const Timings& timings, const std::vector<MemoryLevel>& levels);

}  // namespace pelagic::tools
