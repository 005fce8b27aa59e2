// The names of what an export writes about itself: its record, its journal and its locks, and those of its shards.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "pelagic/tools/export/shard.hpp"

namespace pelagic::tools {

inline constexpr const char* lock_name = ".sea.lock";

/// What an export holds, for people and tools; nothing is read back from it but the sea.
inline constexpr const char* sea_json_name = "sea.json";

/// "sea_files.json", or of a shard "sea.3-of-8.json".
std::string record_name(const std::optional<Shard>& shard);
/// ".pelagic-export.jsonl", or of a shard ".pelagic-export.3-of-8.jsonl".
std::string journal_name(const std::optional<Shard>& shard);
/// ".sea.3-of-8.lock".
std::string lock_name_of(const Shard& shard);

/// The shard whose record has the name; none for other names.
std::optional<Shard> shard_of_record(std::string_view name);
/// True for the record, journal and lock of a shard.
bool is_of_shard(std::string_view name);
/// True for all of these names.
bool is_record_name(std::string_view name);

}  // namespace pelagic::tools
