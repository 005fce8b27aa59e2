// What `pelagic bench` says, for people.
#pragma once

#include "pelagic/tools/benchmark/frame_timing.hpp"

namespace pelagic::tools {

/// Prints, within 100 columns: jobs and frames on one thread with each instruction set, frames on more threads, and frames of
/// other machines beside them.
void print_timings(const Timings& timings);

}  // namespace pelagic::tools
