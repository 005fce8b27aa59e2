#include "pelagic/tools/sequence_output.hpp"

#include "pelagic/tools/mesh_sequences.hpp"

namespace pelagic::tools {

std::vector<std::unique_ptr<SequenceOutput>> sequence_outputs(const ExportOptions& options) {
    return mesh_sequences(options);
}

}  // namespace pelagic::tools
