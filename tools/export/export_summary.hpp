// What an export prints about itself: notes before its first frame, and a summary when it is done.
#pragma once

#include <cstddef>
#include <cstdio>

#include "pelagic/tools/export/export_options.hpp"

namespace pelagic::tools {

struct ExportSummary {
    std::size_t frames = 0;
    std::size_t kept = 0;     ///< of them, that --resume found
    double height_sum_m = 0;  ///< of their significant wave heights
};

/// Prints one line: folder, frames, significant wave height and peak period.
void print_summary(std::FILE* to, const ExportOptions& options, const ExportSummary& summary);

/// Prints a line for each warning about the sea, the events and the mesh. A shard has none: the merge of all shards prints them.
void print_notes(std::FILE* to, const ExportOptions& options);

}  // namespace pelagic::tools
