// Copy speed of each level of the memory hierarchy on this machine, beside the bytes that a frame
// moves there.
#pragma once

#include <cstddef>
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

/// Bytes per texel that a frame of a sea moves beyond a cache of a size.
struct CountedBytes {
    std::string sea;  ///< such as "1x256" or "4x128"
    std::size_t cache_bytes;
    double bytes_per_texel;
};

/// Reads counts by bench/instructions/instructions.py. Throws InputError.
/// \param option  option that named the file
std::vector<CountedBytes> read_counted_bytes(const std::string& option, const std::string& file);

/// Returns the bytes of a frame for each level except the first, from counts for a cache as large
/// as the preceding level, or for the next smaller one. Empty if the sea has not been counted.
std::vector<MovedBytes> moved_bytes(const FrameTiming& frame, const std::vector<MemoryLevel>& levels,
                                    const std::vector<CountedBytes>& counts);

/// Prints the levels, and for each sea the bytes and the level that takes longest.
void print_moved_bytes(const Timings& timings, const std::vector<MemoryLevel>& levels,
                       const std::vector<CountedBytes>& counts);

}  // namespace pelagic::tools
