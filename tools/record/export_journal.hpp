// What makes --resume safe: a file beside the frames that says which of them are done.
//
// Line 1 holds the options of the export and the files of an older one that it replaces, each further line a frame whose
// files stand under their final names, on the disk. The journal is removed when the export's record (sea_files.json), which
// holds the same entries, and sea.json are whole; a finished export is resumed from the record. A frame counts as done only if
// its entry is what this export would write (export_record.hpp) and every file of it still has the recorded XXH3, so torn,
// edited and deleted files and edited entries are made again.
//
// A shard has a journal and a record of its own and leaves all others alone: those of an export with other options it does
// not join, and those with the same say the same of its frames.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/tools/files/output_folder.hpp"
#include "pelagic/tools/record/export_record.hpp"

namespace pelagic::tools {

class ExportJournal {
   public:
    /// Looks at what is in the folder. Throws InputError if
    ///   - neither --resume, --overwrite nor --shard was given, and a finished export or shards of one are there;
    ///   - --resume was given, and the earlier export had other options (the line names the first that differs) or left no
    ///     usable record;
    ///   - --shard was given, and what is there for all frames is an export with other options;
    /// and FileError if a record can't be read or is no regular file.
    ExportJournal(const ExportOptions& options, const OutputFolder& folder);

    /// Frames that are whole already; empty without --resume.
    const std::map<int, FrameRecord>& done() const { return done_; }

    /// Starts the new export: from here on no record claims the folder, unless a shard is
    /// made or an export is resumed. Throws FileError.
    void begin();
    /// The frame's files are done. Throws FileError.
    void add(const FrameRecord& record);
    /// Writes the record and sea.json, or the shard's record, then removes the journal, files of an earlier export that this one
    /// did not make again, unless a shard is made, and parts that a killed one left behind. \param sequence_files  made of all frames together
    void end(const std::vector<FrameRecord>& frames, const std::vector<FileRecord>& sequence_files);

   private:
    void read_earlier();
    /// An interrupted export may be begun anew: what is finished is replaced only where that is asked for.
    void require_nothing_finished() const;
    std::optional<EarlierExport> read_record_or_journal() const;
    void join_others(const std::vector<int>& here);
    /// Files of an earlier export, parts, and what shards have said of themselves: they are older than this export.
    void remove_what_is_left(const std::vector<FrameRecord>& frames, const std::vector<FileRecord>& sequence_files);
    bool is_whole(const FrameRecord& record) const;

    const ExportOptions& options_;
    const OutputFolder& folder_;
    const std::string record_name_, journal_name_;
    Descriptor journal_;
    std::map<int, FrameRecord> done_;
    std::vector<std::string> earlier_images_;
};

}  // namespace pelagic::tools
