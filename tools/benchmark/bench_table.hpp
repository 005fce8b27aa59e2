// The tables of `pelagic bench` and of its options --headset and --cost. docs/integrations/vr.md lists modelled times
// of a headset's cores.
#pragma once

#include <string>
#include <vector>

#include "pelagic/tools/benchmark/frame_timing.hpp"
#include "pelagic/tools/benchmark/option_cost.hpp"

namespace pelagic::tools {

/// Prints tables of at most 100 columns: jobs and frames on one thread with each instruction set,
/// and frames on several threads.
void print_timings(const Timings& timings);

/// Prints a table of at most 100 columns with a row for each sea and number of threads:
/// milliseconds, percentage of a headset's frame, memory, and bytes to upload.
void print_headset_timings(const Timings& timings);

/// Prints a table of at most 100 columns with a row for each option: processor time and memory, and the
/// ratios to the first row.
void print_option_costs(const std::string& sea, Isa isa, const std::vector<OptionCost>& costs);

}  // namespace pelagic::tools
