// Names of an export's record, journal and locks, and of those of its shards.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "pelagic/tools/export/shard.hpp"

namespace pelagic::tools {

inline constexpr const char* lock_name = ".sea.lock";

/// Description of the export for users and other programs, and for `info --measure`. --resume and
/// merge read the record instead.
inline constexpr const char* sea_json_name = "sea.json";

/// Returns "sea_files.json", or for a shard "sea.3-of-8.json".
std::string record_name(const std::optional<Shard>& shard);
/// Returns ".pelagic-export.jsonl", or for a shard ".pelagic-export.3-of-8.jsonl".
std::string journal_name(const std::optional<Shard>& shard);
/// Returns ".sea.3-of-8.lock".
std::string lock_name_of(const Shard& shard);

/// Returns the shard whose record has the name; none for other names.
std::optional<Shard> shard_of_record(std::string_view name);
/// Returns true for the record, journal and lock of a shard.
bool is_of_shard(std::string_view name);
/// Returns true for the names of all records, journals and locks.
bool is_record_name(std::string_view name);

}  // namespace pelagic::tools
