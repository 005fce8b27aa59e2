// `pelagic export`: a sea as image files, one set a frame, and sea.json.
#pragma once

#include "pelagic/tools/export_options.hpp"

namespace pelagic::tools {

/// Throws InputError and FileError. Prints a summary on stdout, progress on stderr if that is a terminal.
void run_export(const ExportOptions& options);

}  // namespace pelagic::tools
