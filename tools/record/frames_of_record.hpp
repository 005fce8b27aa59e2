// Reading and checking of a record's frames. Each entry must equal the one that this export would
// write at its place.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "pelagic/tools/record/record_file.hpp"

namespace pelagic::tools {

/// Range of indices in an export: [begin, end).
struct Places {
    std::size_t begin = 0, end = 0;
};

/// Reads the frames up to the first invalid one.
/// \param head  checks the keys before the frames
/// \param take  receives each frame and its index in the export
/// \returns the error in the record, as text that follows the record's name; empty if the record is
/// valid
/// \throws FileError  if reading fails; also throws what `head` throws
std::string read_frames(const OutputFolder& folder, const std::string& name, const ExportOptions& options,
                        Places places, const std::function<void(const ReadJson& head)>& head,
                        const std::function<void(std::size_t place, FrameRecord&& frame)>& take);

}  // namespace pelagic::tools
