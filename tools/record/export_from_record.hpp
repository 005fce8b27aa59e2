// The way back: from a record to the options of the export that wrote it, and to the command line that would write it again.
//
// Keys under "export" are the options' names with underscores, and units: "start_s" is --start. So a record is read by giving
// its values to the command line's own parser, and is believed only if what comes out says of itself what the record says. An
// option that is missing here is found by that, and by a test that tries each option of `pelagic export`.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "pelagic/tools/record/export_record.hpp"

namespace pelagic::tools {

/// \param head  of a record, see record_file.hpp
/// \param file  where the record is; its folder becomes that of the options
/// Throws InputError, one line that names the file: another version of pelagic has written it, or an option is unknown or out
/// of its range; and DamagedRecord where it has no options at all.
ExportOptions options_of_record(const ReadJson& head, const std::filesystem::path& file);

/// The words behind `pelagic export` that decide what is in the files, without the sea: "--out", "waves", "--mips", ...
std::vector<std::string> words_of(const ExportOptions& options);

/// A line for a shell that makes the export or the shard, with --resume or --overwrite if the options say so.
/// \param record  that the sea is taken from
std::string command_line_of(const ExportOptions& options, const std::filesystem::path& record);

}  // namespace pelagic::tools
