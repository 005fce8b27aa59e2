// What an export will be, before it is made: a sheet of its maps, a short film of its sea, how many files and bytes.
#pragma once

#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/export/export_options.hpp"
#include "pelagic/tools/files/output_folder.hpp"

namespace pelagic::tools {

inline constexpr const char* preview_sheet_name = "preview.png";
inline constexpr const char* preview_film_name = "preview.mp4";
inline constexpr const char* preview_strip_name = "preview_loop.png";  ///< instead of the film, without ffmpeg

/// Writes the sheet and the film, or a strip of its frames, and says on stdout what the export will have. Throws FileError, and
/// Stopped after a signal.
/// \param how  as for the export
void preview_export(const ExportOptions& options, OceanOptions how, const OutputFolder& folder);

}  // namespace pelagic::tools
