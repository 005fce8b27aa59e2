// Streaming input and output of sea.json and of records, which may be larger than memory. Frames
// are written and read one at a time, each on a line.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "pelagic/tools/files/output_folder.hpp"
#include "pelagic/tools/record/export_record.hpp"

namespace pelagic::tools {

/// Calls its argument for each frame.
using MakeFrames = std::function<void(const std::function<void(const FrameRecord&)>&)>;

/// Writes `head` with a list of "frames" as its last key. Throws FileError.
void write_record(const OutputFolder& folder, const std::string& name, const Json& head,
                  const MakeFrames& make_frames, Json (*as_json)(const FrameRecord&) = frame_as_json);

/// Writes the record and then sea.json of a finished export. Throws FileError.
/// \param make_frames  called once for each of the two files
void write_finished(const OutputFolder& folder, const ExportOptions& options, double mean_significant_wave_height_m,
                    const std::vector<FileRecord>& sequence_files, const MakeFrames& make_frames);

/// Callbacks for reading a record. A callback returns false to stop.
struct RecordTaker {
    /// Receives all keys before "frames", which is last.
    std::function<bool(const ReadJson& head)> head;
    /// Receives each element of the list of frames, of any type.
    std::function<bool(const ReadJson& entry)> frame;
};

/// Reads a record. Returns false if there is no such file. Throws FileError, and DamagedRecord for
/// a malformed record or one with too much data outside of frames.
bool read_record(const OutputFolder& folder, const std::string& name, const RecordTaker& take);

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
