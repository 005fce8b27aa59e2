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
#include <vector>

#include "pelagic/tools/record/export_record.hpp"

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

}  // namespace pelagic::tools
