// The frames of a record, looked at one by one: each must say what this export would say of it, in its place.
#pragma once

#include <cstddef>
#include <functional>
#include <string>

#include "pelagic/tools/record/record_file.hpp"

namespace pelagic::tools {

/// The places in an export that a record is about: from `begin` on, before `end`.
struct Places {
    std::size_t begin = 0, end = 0;
};

/// Reads the frames up to the first that is wrong.
/// \param head  looks at what stands before the frames
/// \param take  gets each frame and its place in the export
/// What is wrong with the record, in words that follow its name; empty if nothing is. Throws FileError, and what `head` throws.
std::string read_frames(const OutputFolder& folder, const std::string& name, const ExportOptions& options,
                        Places places, const std::function<void(const ReadJson& head)>& head,
                        const std::function<void(std::size_t place, FrameRecord&& frame)>& take);

}  // namespace pelagic::tools
