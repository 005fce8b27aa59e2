// What makes --resume safe: a file beside the frames that says which of them are done.
//
// Line 1 holds the options of the export and the files of an older one that it replaces, each further line a frame whose
// files stand under their final names, on the disk. The journal is removed when sea.json, which holds the same records, is
// whole; a finished export is resumed from that. A frame counts as done only if its record is what this export would
// write (export_record.hpp) and every file of it still has the recorded XXH3, so torn, edited and deleted files and
// edited records are made again.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "pelagic/tools/export_record.hpp"
#include "pelagic/tools/output_folder.hpp"

namespace pelagic::tools {

class ExportJournal {
   public:
    /// Looks at what is in the folder. Throws InputError if --resume was asked for and the earlier export had other
    /// options (the line names the first that differs) or left no usable record; FileError if a record can't be read or
    /// is no regular file.
    ExportJournal(const ExportOptions& options, const OutputFolder& folder);

    /// Frames that are whole already; empty without --resume.
    const std::map<int, FrameRecord>& done() const { return done_; }

    /// Starts the new export: from here on sea.json no longer claims the folder. Throws FileError.
    void begin();
    /// The frame's files are done. Throws FileError.
    void add(const FrameRecord& record);
    /// Writes sea.json, then removes the journal, files of an earlier export that this one did not make again, and
    /// parts that a killed one left behind. \param sequence_files  made of all frames together
    void end(const std::vector<FrameRecord>& frames, const std::vector<FileRecord>& sequence_files);

   private:
    void read_earlier();
    bool is_whole(const FrameRecord& record) const;

    const ExportOptions& options_;
    const OutputFolder& folder_;
    Descriptor journal_;
    std::map<int, FrameRecord> done_;
    std::vector<std::string> earlier_images_;
};

}  // namespace pelagic::tools
