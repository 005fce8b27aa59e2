// `pelagic export`: a sea as image files, one set a frame, and sea.json.
#pragma once

#include <memory>

#include "pelagic/jobs/chrome_trace.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/export/export_options.hpp"

namespace pelagic::tools {

/// What an ocean is told so that its frames have what the files need. \param trace  may be none
OceanOptions ocean_options(const ExportOptions& options, const std::shared_ptr<ChromeTrace>& trace);

/// Throws InputError and FileError. Prints a summary on stdout, progress on stderr if that is a terminal.
void run_export(const ExportOptions& options);

}  // namespace pelagic::tools
