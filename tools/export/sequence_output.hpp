// What is made of all frames together, a film or an atlas: fed one after the other, after the images are done.
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
    /// Frames of the export in order. \param index  its place in the export
    virtual void add(std::size_t index, const Frame& frame) = 0;
    virtual std::vector<File> finish() = 0;
};

/// Those that the options ask for.
std::vector<std::unique_ptr<SequenceOutput>> sequence_outputs(const ExportOptions& options);

}  // namespace pelagic::tools
