// sea.json and the records of exports and shards as files that may be larger than memory: written and read frame by frame, each a
// line.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "pelagic/tools/files/output_folder.hpp"
#include "pelagic/tools/record/export_record.hpp"

namespace pelagic::tools {

/// Is given what takes a frame, and calls it for each.
using MakeFrames = std::function<void(const std::function<void(const FrameRecord&)>&)>;

/// Writes `head` with a list of "frames" as its last key. Throws FileError.
void write_record(const OutputFolder& folder, const std::string& name, const Json& head,
                  const MakeFrames& make_frames, Json (*as_json)(const FrameRecord&) = frame_as_json);

/// Writes what a finished export has: its record, and then sea.json. Throws FileError.
/// \param make_frames  is called once for each of the two
void write_finished(const OutputFolder& folder, const ExportOptions& options, double mean_significant_wave_height_m,
                    const std::vector<FileRecord>& sequence_files, const MakeFrames& make_frames);

/// What takes a record that is read; each may answer false: no more.
struct RecordTaker {
    /// All keys before "frames", which comes last.
    std::function<bool(const ReadJson& head)> head;
    /// What is in the list, one after the other, whatever it is.
    std::function<bool(const ReadJson& entry)> frame;
};

/// False if nothing has the name. Throws DamagedRecord, also for one that holds much else than frames, and FileError.
bool read_record(const OutputFolder& folder, const std::string& name, const RecordTaker& take);

}  // namespace pelagic::tools
