// `pelagic bench --headset`: what a headset may choose, and what it takes here. docs/users/headset.md has the same rows for a
// headset's cores, by a model.
#pragma once

#include <vector>

#include "pelagic/sim/sea_state.hpp"
#include "pelagic/tools/benchmark/frame_timing.hpp"

namespace pelagic::tools {

/// More cores than that are slow ones, or the renderer's.
inline constexpr int max_headset_threads = 3;

/// One cascade of 128 and of 256, three of 64, three and four of 128.
std::vector<SeaState> headset_seas();

/// Prints, within 100 columns, a line for each sea and number of threads: milliseconds, the part of a headset's frame that
/// they are, memory, and bytes to upload.
void print_headset_timings(const Timings& timings);

}  // namespace pelagic::tools
