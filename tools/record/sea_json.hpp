// sea.json: what an export holds and how it was made. And the record of an export, which keeps what --resume, merge and verify
// need: the options and the XXH3 of each file. Both are the same on every machine: no times, paths or thread counts.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "pelagic/sim/statistics.hpp"
#include "pelagic/tools/export/export_options.hpp"

namespace pelagic::tools {

using Json = nlohmann::ordered_json;

/// A file of a frame and the XXH3 of its bytes, by which --resume knows that it is whole.
struct FileRecord {
    std::string name;
    std::string xxh3;
};

/// What sea.json, the record and the journal say of one frame.
struct FrameRecord {
    int frame = 0;
    double time_s = 0;
    std::string hash;                ///< hash_of() as 16 hexadecimal digits
    std::string foam_hash;           ///< foam_hash_of() likewise; empty without maps of foam
    std::string dynamic_waves_hash;  ///< dynamic_waves_hash_of() likewise; empty without events
    double significant_wave_height_m = 0;
    double height_min_m = 0, height_max_m = 0;
    std::vector<FileRecord> files;
};

/// Every option of a sea, resolved; keys as in a config file, with units.
Json sea_as_json(const ResolvedSea& sea);

/// What it turns into: [{"from_s", "over_s", "sea"}], empty without weather.
Json weather_as_json(const ResolvedSea& sea);

/// Every option that decides what is in the files: {"version", "sea", "weather" if there is any, "export"}.
Json options_as_json(const ExportOptions& options);

/// Returns what records and the journal hold of a frame, with an XXH3 of it by which an edited one is known.
Json frame_as_json(const FrameRecord& record);

/// Returns what sea.json holds of a frame: the same, with the names of files and without their XXH3.
Json frame_summary_as_json(const FrameRecord& record);

/// Heights, periods, directions, slopes, expected by the model and measured: {"significant_wave_height_m", ...}.
Json waves_as_json(const SeaState& sea, const SeaReport& report, double measured_significant_wave_height_m);

/// repeat_length_m() of a sea and of what it turns into.
double repeats_after_m(const ResolvedSea& sea);

/// When foam is remembered, how it drifts, how much of it there is: {"whitecap_cover", "tick_s", ...}.
Json foam_as_json(const Frame& frame);

/// All of sea.json but its frames. \param sequence_files  made of all frames together
Json sea_json_head(const ExportOptions& options, double mean_significant_wave_height_m,
                   const std::vector<FileRecord>& sequence_files);

/// All of an export's record but its frames: its options, and the files that are made of all frames together.
Json record_head(const ExportOptions& options, const std::vector<FileRecord>& sequence_files);

/// The same of a shard's record: its options, and {"shard": {"index", "count"}}.
Json shard_head(const ExportOptions& options);

}  // namespace pelagic::tools
