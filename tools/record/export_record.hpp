// What an earlier export wrote about itself, read back with the greatest suspicion: anybody may have edited it.
//
// A frame of it counts only if it is, word by word, what this export would write about that frame itself; of the names in
// it only those are taken that an export can have given. All else is as if it were not there.
#pragma once

#include <cstddef>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/tools/record/sea_json.hpp"

namespace pelagic::tools {

/// With sorted keys, so that a file of a million keys is read in no time. (Json looks each new key up among all others.)
using ReadJson = nlohmann::json;

/// A record that is no record at all: malformed, nested too deeply, or without options.
struct DamagedRecord : std::runtime_error {
    DamagedRecord() : std::runtime_error("the record is damaged") {}
};

struct EarlierExport {
    ReadJson options;                   ///< as options_as_json() writes them
    std::map<int, FrameRecord> frames;  ///< those that count
    std::vector<std::string>
        images;  ///< that this export replaces: names that an export can have given, and no others
};

/// The texts of a journal and of a record. Throws DamagedRecord.
EarlierExport parse_journal(std::string_view text, const ExportOptions& options);
EarlierExport parse_sea_json(std::string_view text, const ExportOptions& options);

/// The options in the head of a record, as options_as_json() writes them. Throws DamagedRecord if it has none.
ReadJson options_in(const ReadJson& head);

/// The frame that an entry is about, if it says exactly what this export would say.
std::optional<FrameRecord> accepted_frame(const ReadJson& entry, const ExportOptions& options);

/// Larger ones are not read: more than this export or any other of usual size would write.
std::size_t max_record_bytes(const ExportOptions& options);

/// An option as a person reads it.
struct OptionDifference {
    std::string key, before, after;

    std::string was_and_is() const { return key + " was " + before + " and is " + after; }
    std::string is_not() const { return key + " is " + before + ", not " + after; }
};

/// The first value that differs, in the order of `now`.
OptionDifference first_difference(const ReadJson& earlier, const Json& now);

/// The first option of options_as_json() that differs, by its name on the command line: "--maps", "displacement,gradient",
/// "displacement".
OptionDifference first_option_difference(const ReadJson& earlier, const Json& now);

}  // namespace pelagic::tools
