// Frames of an export side by side in one image a map and cascade, for particle systems and shaders that play them, and
// flipbook.json, which says how.
#pragma once

#include <memory>
#include <string>

#include "pelagic/tools/export/export_options.hpp"
#include "pelagic/tools/export/sequence_output.hpp"

namespace pelagic::tools {

/// The widest and highest texture that graphics interfaces have to take (Direct3D 11, Vulkan's usual limit).
inline constexpr int largest_flipbook_side = 16384;

/// Throws InputError, one line, if the frames have no room in the grid or the images would be too large.
void check_flipbook(const ExportOptions& options, const std::string& typed);

/// \pre the options have a flipbook
std::unique_ptr<SequenceOutput> flipbook(const ExportOptions& options);

}  // namespace pelagic::tools
