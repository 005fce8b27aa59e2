// What makes --resume safe: a file beside the frames that says which of them are done.
//
// Line 1 holds the options of the export and the files of an older one that it replaces, each further line a frame whose files stand under their final names. The
// journal is removed when sea.json, which holds the same records, is whole; a finished export is resumed from that.
// A frame counts as done only if every file of it still has the recorded XXH3, so torn, edited and deleted files are
// made again.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "pelagic/tools/sea_json.hpp"

namespace pelagic::tools {

inline constexpr const char* journal_name = ".pelagic-export.jsonl";
inline constexpr const char* sea_json_name = "sea.json";

/// True for names that an export gives to files of its own.
bool is_export_file(const std::string& name);

class ExportJournal {
   public:
    /// Looks at what is in the folder. Throws InputError if --resume was asked for and the earlier export had other
    /// options: the line names the first that differs.
    explicit ExportJournal(const ExportOptions& options);

    /// Frames that are whole already; empty without --resume.
    const std::map<int, FrameRecord>& done() const { return done_; }

    /// Starts the new export: from here on sea.json no longer claims the folder. Throws FileError.
    void begin();
    void add(const FrameRecord& record);
    /// Writes sea.json, then removes the journal, files of an earlier export that this one did not make again, and
    /// parts that a killed one left behind.
    void end(const std::vector<FrameRecord>& frames);

   private:
    void read_earlier(bool resume);
    void forget_torn_frames();

    const ExportOptions& options_;
    std::filesystem::path journal_, sea_json_;
    std::map<int, FrameRecord> done_;
    std::vector<std::string> earlier_files_;
};

/// XXH3 of bytes, as 16 hexadecimal digits.
std::string xxh3_text(const void* bytes, std::size_t size);

}  // namespace pelagic::tools
