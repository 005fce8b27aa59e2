// How many lines lie side by side in memory, whatever the instruction set.
#pragma once

#include <cstddef>

namespace pelagic {

/// Lines (of kz in the first transform, of x in the second) whose values stand next to each other: one AVX-512
/// register, two of AVX2, four of SSE or NEON. One constant for all, so that buffers look the same everywhere.
inline constexpr std::size_t lane_block = 16;

}  // namespace pelagic
