// Text that an export prints: notes before the first frame, and a summary at the end.
#pragma once

#include <cstddef>
#include <cstdio>
#include <string>

#include "pelagic/tools/export/export_options.hpp"

namespace pelagic::tools {

struct ExportSummary {
    std::size_t frames = 0;
    std::size_t kept = 0;     ///< frames of an earlier run that --resume kept
    double height_sum_m = 0;  ///< sum of the frames' significant wave heights, metres
};

/// Prints one line: folder, frames, mean significant wave height and peak period.
void print_summary(std::FILE* to, const ExportOptions& options, const ExportSummary& summary);

/// Prints a note on stderr for each warning about the sea, the events and the mesh. Prints none for
/// a shard; the merge prints them.
void print_notes(const ExportOptions& options);

}  // namespace pelagic::tools
