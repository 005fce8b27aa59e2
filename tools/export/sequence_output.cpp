#include "pelagic/tools/export/sequence_output.hpp"

#include "pelagic/tools/export/flipbook.hpp"
#include "pelagic/tools/export/mesh_sequences.hpp"

namespace pelagic::tools {

std::vector<std::unique_ptr<SequenceOutput>> sequence_outputs(const ExportOptions& options) {
    std::vector<std::unique_ptr<SequenceOutput>> outputs = mesh_sequences(options);
    if (options.flipbook) outputs.push_back(flipbook(options));
    return outputs;
}

}  // namespace pelagic::tools
