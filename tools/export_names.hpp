// The names of an export's files, and no others: what a record names is believed only if it is one of these.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "pelagic/tools/export_options.hpp"

namespace pelagic::tools {

inline constexpr const char* sea_json_name = "sea.json";
inline constexpr const char* journal_name = ".pelagic-export.jsonl";
inline constexpr const char* lock_name = ".sea.lock";

/// "displacement_0007.exr" of the coarsest tile, 0, and "displacement_c1_0007.exr" of the next one.
std::string displacement_name(const ExportOptions& options, int tile, int frame);
/// "gradient_0007.png", or "gradient_c1_0007_mip2.png" for level 2 of tile 1.
std::string gradient_name(const ExportOptions& options, int tile, int frame, int level);
/// "foam_0007.png", likewise.
std::string foam_name(const ExportOptions& options, int tile, int frame, int level);

/// How many levels of the gradient, and of foam, each tile of a frame has files of.
int gradient_levels(const ExportOptions& options);
int foam_levels(const ExportOptions& options);

/// Every image of a frame, in the order in which records list them.
std::vector<std::string> image_names(const ExportOptions& options, int frame);

/// True for what the functions above can give, with any options.
bool is_image_name(std::string_view name);

/// True for names that an export gives to files of its own: images, records, the lock, and their parts.
bool is_export_name(std::string_view name);

}  // namespace pelagic::tools
