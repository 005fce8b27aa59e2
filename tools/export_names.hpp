// The names of an export's files, and no others: what a record names is believed only if it is one of these.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "pelagic/tools/map_options.hpp"
#include "pelagic/tools/shard.hpp"

namespace pelagic::tools {

inline constexpr const char* lock_name = ".sea.lock";

/// "sea.json", or of a shard "sea.3-of-8.json".
std::string record_name(const std::optional<Shard>& shard);
/// ".pelagic-export.jsonl", or of a shard ".pelagic-export.3-of-8.jsonl".
std::string journal_name(const std::optional<Shard>& shard);
/// ".sea.3-of-8.lock".
std::string lock_name_of(const Shard& shard);

/// The shard whose record has the name; none for other names.
std::optional<Shard> shard_of_record(std::string_view name);
/// True for the record, journal and lock of a shard.
bool is_of_shard(std::string_view name);

/// "displacement_0007.exr" of the coarsest tile, 0; "gradient_c1_0007_mip2.png" for level 2 of the next one.
std::string image_name(const MapOptions& options, MapKind map, int tile, int frame, int level);

/// "exr", "png" or "tif": by the type of the map's values.
const char* extension_of(MapKind map, const MapOptions& options);

/// True for what image_name() can give, with any options.
bool is_image_name(std::string_view name);

/// True for names that an export gives to files of its own: images, records, journals, locks, and their parts.
bool is_export_name(std::string_view name);

/// True for the part of such a file, which a killed export has left.
bool is_export_part(std::string_view name);

}  // namespace pelagic::tools
