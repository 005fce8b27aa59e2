// Reading of records and journals of an earlier export. They are untrusted input: users may have
// edited them.
//
// A frame is accepted only if its entry equals the one that this export would write for it. File
// names are accepted only if an export can have created them. Everything else is ignored.
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

/// JSON with sorted keys, so that lookups in a file of a million keys are fast. (Json compares each
/// new key with all others.)
using ReadJson = nlohmann::json;

/// Returns the value of a key; null if there is none, or if `json` is not an object.
const ReadJson& value_of(const ReadJson& json, const std::string& key);

/// Thrown for a record that is malformed, nested too deeply, or has no options.
struct DamagedRecord : std::runtime_error {
    DamagedRecord() : std::runtime_error("the record is damaged") {}
};

struct EarlierExport {
    ReadJson options;                   ///< in the form of options_as_json()
    std::map<int, FrameRecord> frames;  ///< accepted frames
    /// Files that this export replaces; only names that an export can have given.
    std::vector<std::string> images;
};

/// Parse the text of a journal or of a record. Throw DamagedRecord.
EarlierExport parse_journal(std::string_view text, const ExportOptions& options);
EarlierExport parse_sea_json(std::string_view text, const ExportOptions& options);

/// Returns the options in the head of a record, in the form of options_as_json(). Throws
/// DamagedRecord if it has none.
ReadJson options_in(const ReadJson& head);

/// Returns the frame of an entry; none unless the entry equals the one that this export would
/// write.
std::optional<FrameRecord> accepted_frame(const ReadJson& entry, const ExportOptions& options);

/// Returns the size limit for reading a record or journal, in bytes: larger than what this export,
/// or any other of usual size, writes.
std::size_t max_record_bytes(const ExportOptions& options);

/// An option whose values differ, as text for messages.
struct OptionDifference {
    std::string key, before, after;

    std::string was_and_is() const { return key + " was " + before + " and is " + after; }
    std::string is_not() const { return key + " is " + before + ", not " + after; }
};

/// Returns the first value that differs, in the order of `now`.
OptionDifference first_difference(const ReadJson& earlier, const Json& now);

/// Returns the first option of options_as_json() that differs, by its name on the command line:
/// "--maps", "displacement,gradient", "displacement".
OptionDifference first_option_difference(const ReadJson& earlier, const Json& now);

}  // namespace pelagic::tools
