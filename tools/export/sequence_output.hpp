// Outputs made of all frames together: flipbooks, animations of morph targets, and point caches.
//
// A flipbook has all frames of an export side by side in one image for each map and cascade, for
// particle systems and shaders. flipbook.json describes the layout.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/export/export_options.hpp"

namespace pelagic::tools {

/// Frames are added in order, each as soon as it is computed.
class SequenceOutput {
   public:
    struct File {
        std::string name;
        std::vector<unsigned char> bytes;
    };

    virtual ~SequenceOutput() = default;
    /// Adds the next frame of the export.
    /// \param index  index of the frame in the export
    virtual void add(std::size_t index, const Frame& frame) = 0;
    virtual std::vector<File> finish() = 0;
};

/// Returns the output that --mesh selects, of mesh.glb and mesh.mdd; empty without them.
std::vector<std::unique_ptr<SequenceOutput>> mesh_sequences(const ExportOptions& options);

/// Returns the outputs that the options select.
std::vector<std::unique_ptr<SequenceOutput>> sequence_outputs(const ExportOptions& options);

/// Maximum texture size that graphics APIs support (Direct3D 11; usual limit of Vulkan).
inline constexpr int largest_flipbook_side = 16384;

/// Throws InputError, one line, if the frames do not fit into the grid or the images would be too
/// large.
void check_flipbook(const ExportOptions& options, const std::string& typed);

}  // namespace pelagic::tools
