// Flipbooks: all frames of an export side by side in one image for each map and cascade, for
// particle systems and shaders. flipbook.json describes the layout.
#pragma once

#include <memory>
#include <string>

#include "pelagic/tools/export/export_options.hpp"
#include "pelagic/tools/export/sequence_output.hpp"

namespace pelagic::tools {

/// Maximum texture size that graphics APIs support (Direct3D 11; usual limit of Vulkan).
inline constexpr int largest_flipbook_side = 16384;

/// Throws InputError, one line, if the frames do not fit into the grid or the images would be too
/// large.
void check_flipbook(const ExportOptions& options, const std::string& typed);

/// Returns the output that writes the flipbooks.
/// \pre the options have a flipbook
std::unique_ptr<SequenceOutput> flipbook(const ExportOptions& options);

}  // namespace pelagic::tools
