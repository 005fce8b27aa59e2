// Contents of sea.json, which describes an export and how it was made, and of the record, which
// --resume, merge and verify need: the options and the XXH3 of each file. Both are identical on
// every machine: they contain no times, paths or thread counts.
#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/export/export_options.hpp"

namespace pelagic::tools {

using Json = nlohmann::ordered_json;

/// A file of a frame and the XXH3 of its bytes, by which --resume detects incomplete files.
struct FileRecord {
    std::string name;
    std::string xxh3;
};

/// Data of one frame in sea.json, the record and the journal.
struct FrameRecord {
    int frame = 0;
    double time_s = 0;
    std::string hash;       ///< hash_of() as 16 hexadecimal digits
    std::string foam_hash;  ///< foam_hash_of() as 16 hexadecimal digits; empty without maps of foam
    /// hash_of() of the dynamic waves; empty without events
    std::string dynamic_waves_hash;
    double significant_wave_height_m = 0;
    double height_min_m = 0, height_max_m = 0;
    std::vector<FileRecord> files;
};

/// Returns every option of a sea, resolved; keys as in a configuration file, with units.
Json sea_as_json(const ResolvedSea& sea);

/// Returns the sea-state transitions, [{"from_s", "over_s", "sea"}]; empty without weather.
Json weather_as_json(const ResolvedSea& sea);

/// Returns every option that determines the contents of the files: {"version", "sea", "weather" if
/// there is any, "export"}.
Json options_as_json(const ExportOptions& options);

/// Returns the entry of a frame in records and the journal, with the XXH3 of the entry, which
/// detects edits.
Json frame_as_json(const FrameRecord& record);

/// Returns the entry of a frame in sea.json: frame_as_json() with the names of files but without
/// their XXH3.
Json frame_summary_as_json(const FrameRecord& record);

/// Returns heights, periods, directions and slopes, expected by the model and measured:
/// {"significant_wave_height_m", ...}. Without a measured height, all measured values are null.
Json waves_as_json(const SeaState& sea, const SeaReport& report,
                   std::optional<double> measured_significant_wave_height_m);

/// Returns the distance after which a sea with its transitions repeats: the side of the coarsest
/// cascade, in metres.
double repeats_after_m(const ResolvedSea& sea);

/// Returns ticks, drift and coverage of foam: {"whitecap_cover", "tick_s", ...}.
Json foam_as_json(const Frame& frame);

/// Returns the warnings about a sea and its transitions.
std::vector<std::string> warnings_of(const ResolvedSea& sea, const SeaReport& report);

/// Returns sea.json without its frames.
/// \param sequence_files  files made of all frames together
Json sea_json_head(const ExportOptions& options, double mean_significant_wave_height_m,
                   const std::vector<FileRecord>& sequence_files);

/// Returns an export's record without its frames: the options, and the files made of all frames
/// together.
Json record_head(const ExportOptions& options, const std::vector<FileRecord>& sequence_files);

/// Returns a shard's record without its frames: the options, and {"shard": {"index", "count"}}.
Json shard_head(const ExportOptions& options);

}  // namespace pelagic::tools
