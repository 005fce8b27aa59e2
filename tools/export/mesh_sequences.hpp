// Files with the meshes of all frames: an animation of morph targets, and a point cache.
#pragma once

#include <memory>
#include <vector>

#include "pelagic/tools/export/sequence_output.hpp"

namespace pelagic::tools {

/// Returns the outputs that --mesh selects: mesh.glb, mesh.mdd.
std::vector<std::unique_ptr<SequenceOutput>> mesh_sequences(const ExportOptions& options);

}  // namespace pelagic::tools
