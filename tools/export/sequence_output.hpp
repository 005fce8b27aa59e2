// Interface of outputs made of all frames together, such as flipbooks and animations. The frames
// are added in order, after the images are written.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "pelagic/sim/frame.hpp"
#include "pelagic/tools/export/export_options.hpp"

namespace pelagic::tools {

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

/// Returns the outputs that the options select.
std::vector<std::unique_ptr<SequenceOutput>> sequence_outputs(const ExportOptions& options);

}  // namespace pelagic::tools
