// The names of an export's files, and no others: what a record names is believed only if it is one of these.
#pragma once

#include <string>
#include <string_view>

#include "pelagic/tools/map_options.hpp"

namespace pelagic::tools {

inline constexpr const char* sea_json_name = "sea.json";
inline constexpr const char* journal_name = ".pelagic-export.jsonl";
inline constexpr const char* lock_name = ".sea.lock";

/// "displacement_0007.exr" of the coarsest tile, 0; "gradient_c1_0007_mip2.png" for level 2 of the next one.
std::string image_name(const MapOptions& options, MapKind map, int tile, int frame, int level);

/// "exr" or "png" by the type of the map's values, or the format's own.
const char* extension_of(MapKind map, const MapOptions& options);

/// True for what image_name() can give, with any options.
bool is_image_name(std::string_view name);

/// True for names that an export gives to files of its own: images, records, the lock, and their parts.
bool is_export_name(std::string_view name);

}  // namespace pelagic::tools
