// Meshes of all frames in one file: an animation of morph targets, a point cache.
#pragma once

#include <memory>
#include <vector>

#include "pelagic/tools/export/sequence_output.hpp"

namespace pelagic::tools {

/// Those that --mesh asks for: mesh.glb, mesh.mdd.
std::vector<std::unique_ptr<SequenceOutput>> mesh_sequences(const ExportOptions& options);

}  // namespace pelagic::tools
