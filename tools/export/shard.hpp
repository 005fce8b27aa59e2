// Shards: equal pieces into which the frames of an export are split for several machines; and the
// names of records, journals and locks of an export and of its shards.
//
// A shard is a run of consecutive frames, so that foam is warmed up once for each shard. Shard I of
// N has the frames with indices from (I - 1) n / N up to but excluding I n / N, rounded down, of n
// frames. The sizes of shards differ by at most one frame. With more shards than frames, some are
// empty.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace pelagic::tools {

struct Shard {
    static constexpr int max_count = 1'000'000;

    int index = 1;  ///< 1 to count
    int count = 1;

    /// Range of indices [begin, end) of the shard's frames.
    /// \param frames  number of frames of the export
    std::size_t begin(std::size_t frames) const { return place(index - 1, frames); }
    std::size_t end(std::size_t frames) const { return place(index, frames); }

    bool operator==(const Shard&) const = default;

   private:
    std::size_t place(int shards, std::size_t frames) const {
        return static_cast<std::size_t>(shards) * frames / static_cast<std::size_t>(count);
    }
};

/// Returns "3/8", the format of --shard.
std::string text_of(const Shard& shard);
std::optional<Shard> parse_shard(std::string_view text);

/// Returns "3-of-8", the format in file names.
std::string mark_of(const Shard& shard);
/// Parses the format of mark_of(). Returns none for anything else, including leading zeros or
/// signs.
std::optional<Shard> shard_named(std::string_view text);

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
