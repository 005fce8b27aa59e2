// The tables of `pelagic bench`.
#pragma once

#include "pelagic/tools/benchmark/frame_timing.hpp"

namespace pelagic::tools {

/// Prints tables of at most 100 columns: jobs and frames on one thread with each instruction set,
/// frames on several threads, and a comparison with stored results of other machines.
void print_timings(const Timings& timings);

}  // namespace pelagic::tools
