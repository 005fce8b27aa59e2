// Conversion of a record to the options of the export that wrote it, and to a command line that
// repeats the export.
//
// Keys under "export" are option names with underscores and units: "start_s" is --start. The
// record's values are passed to the parser of the command line. The result is accepted only if its
// own record equals the one that was read. A missing option is detected by this comparison, and by
// a test that tries each option of `pelagic export`.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "pelagic/tools/record/export_record.hpp"
#include "pelagic/tools/record/sea_json.hpp"

namespace pelagic::tools {

/// Reads the options of an export from its record.
/// \param head  keys of the record before "frames", see record_file.hpp
/// \param file  path of the record; its folder becomes the folder of the options
/// \throws InputError  one line with the file name, if another version of pelagic wrote the record,
/// or an option is unknown or out of range
/// \throws DamagedRecord  if the record has no options
ExportOptions options_of_record(const ReadJson& head, const std::filesystem::path& file);

/// Returns the arguments of `pelagic export` that determine the contents of the files, without
/// those of the sea: "--out", "waves", "--mips", ...
std::vector<std::string> words_of(const ExportOptions& options);

/// Returns a shell command that makes the export or the shard, with --resume or --overwrite if the
/// options have them.
/// \param record  record from which the command reads the sea
std::string command_line_of(const ExportOptions& options, const std::filesystem::path& record);

/// Returns "--start" for "start_s", a key under "export". Keys of a nested object are appended to
/// the key of the object: "mesh_side_m" is --mesh-size.
std::string flag_of(const std::string& key);

/// Returns "--wind-speed" for "/sea/wind_speed_mps", a JSON pointer (RFC 6901) into
/// options_as_json(). Returns --weather for a value in a change of the weather, and the key itself
/// for a value that no option sets: "version".
std::string flag_at(std::string_view pointer);

/// Formats a value as on a command line; lists are separated by commas.
std::string typed_value(const Json& value);

}  // namespace pelagic::tools
