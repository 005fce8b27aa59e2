// Shards: equal pieces into which the frames of an export are split for several machines.
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

}  // namespace pelagic::tools
