#include "pelagic/tools/sequence_output.hpp"

namespace pelagic::tools {

std::vector<std::unique_ptr<SequenceOutput>> sequence_outputs(const ExportOptions&) { return {}; }

}  // namespace pelagic::tools
