// Journal for --resume: a file beside the frames that lists the finished ones.
//
// Line 1 holds the options of the export and the files of an earlier export that it replaces. Each
// further line is a frame whose files are on the disk under their final names. The journal is
// removed when the record (sea_files.json), which holds the same entries, and sea.json are
// complete. A finished export is resumed from the record. A frame counts as done only if its entry
// equals the one that this export would write (export_record.hpp) and every file has the recorded
// XXH3. So incomplete, edited and deleted files and edited entries are made again.
//
// A shard has its own journal and record and does not change those of other shards. It rejects a
// folder with an export of other options. Records of all frames with equal options also hold valid
// entries for the shard's frames.
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
    /// Reads the state of the folder. Throws InputError if
    ///   - neither --resume, --overwrite nor --shard is given, and the folder has a finished export
    ///     or shards;
    ///   - --resume is given, and the earlier export had other options (the line names the first
    ///     that differs) or left no usable record;
    ///   - --shard is given, and the record or journal of all frames has other options;
    /// and FileError if a record cannot be read or is not a regular file.
    ExportJournal(const ExportOptions& options, const OutputFolder& folder);

    /// Returns the complete frames of the earlier export; empty without --resume.
    const std::map<int, FrameRecord>& done() const { return done_; }

    /// Starts the new export: writes the journal and, unless a shard is made or an export is
    /// resumed, removes the earlier record. Throws FileError.
    void begin();
    /// Appends a frame whose files are finished. Throws FileError.
    void add(const FrameRecord& record);
    /// Writes the record and sea.json, or the shard's record, then removes the journal. Unless a
    /// shard is made, it also removes files of an earlier export that were not replaced, and
    /// temporary files of a killed run.
    /// \param sequence_files  files made of all frames together
    void end(const std::vector<FrameRecord>& frames, const std::vector<FileRecord>& sequence_files);

   private:
    void read_earlier();
    /// Throws InputError if the folder has a finished export or shards. An interrupted export may
    /// be restarted without an option.
    void require_nothing_finished() const;
    std::optional<EarlierExport> read_record_or_journal() const;
    void join_others(const std::vector<int>& here);
    /// Removes files of an earlier export, temporary files, and records, journals and locks of
    /// shards.
    void remove_stale_files(const std::vector<FrameRecord>& frames, const std::vector<FileRecord>& sequence_files);
    bool is_whole(const FrameRecord& record) const;

    const ExportOptions& options_;
    const OutputFolder& folder_;
    const std::string record_name_, journal_name_;
    Descriptor journal_;
    std::map<int, FrameRecord> done_;
    std::vector<std::string> earlier_images_;
};

}  // namespace pelagic::tools
