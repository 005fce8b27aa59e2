// Preview of an export: a sheet with its maps, a short film of its sea, and the number of files and
// bytes.
#pragma once

#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/export/export_options.hpp"
#include "pelagic/tools/files/output_folder.hpp"

namespace pelagic::tools {

inline constexpr const char* preview_sheet_name = "preview.png";
inline constexpr const char* preview_film_name = "preview.mp4";
/// written instead of the film if ffmpeg is missing
inline constexpr const char* preview_strip_name = "preview_loop.png";

/// Writes the sheet, and the film or a strip of its frames. Prints on stdout what the export will
/// contain. Throws FileError, and Stopped after a signal.
/// \param how  ocean options of the export
void preview_export(const ExportOptions& options, OceanOptions how, const OutputFolder& folder);

}  // namespace pelagic::tools
