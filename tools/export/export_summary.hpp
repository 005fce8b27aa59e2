// What an export says when it is done.
#pragma once

#include <cstddef>

#include "pelagic/tools/export/export_options.hpp"

namespace pelagic::tools {

struct ExportSummary {
    std::size_t frames = 0;
    std::size_t kept = 0;     ///< of them, that --resume found
    double height_sum_m = 0;  ///< of their significant wave heights
};

/// A line on stdout, and one for each warning about the sea, unless it is a shard.
void print_summary(const ExportOptions& options, const ExportSummary& summary);

}  // namespace pelagic::tools
