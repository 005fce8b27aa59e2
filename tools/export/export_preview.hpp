// Preview of an export: a sheet with its maps, and the number of files and bytes. `pelagic render`
// draws the sea itself.
#pragma once

#include "pelagic/tools/export/export_options.hpp"
#include "pelagic/tools/files/output_folder.hpp"

namespace pelagic::tools {

inline constexpr const char* preview_name = "preview.png";

/// Writes the sheet. Prints on stdout what the export will contain. Throws FileError.
void preview_export(const ExportOptions& options, const OutputFolder& folder);

}  // namespace pelagic::tools
