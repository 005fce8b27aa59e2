// One of the equal parts into which the frames of an export are split, so that several machines can make them.
//
// Parts are runs of frames, since the foam of a run is warmed up once. Shard I of N has the frames from place (I - 1) n / N to
// I n / N, rounded down, of n: no two parts differ by more than a frame, and with more shards than frames some are empty.
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

    /// The places of its frames among so many: from begin() on, before end().
    std::size_t begin(std::size_t frames) const { return place(index - 1, frames); }
    std::size_t end(std::size_t frames) const { return place(index, frames); }

    bool operator==(const Shard&) const = default;

   private:
    std::size_t place(int shards, std::size_t frames) const {
        return static_cast<std::size_t>(shards) * frames / static_cast<std::size_t>(count);
    }
};

/// "3/8", as --shard has it.
std::string text_of(const Shard& shard);
std::optional<Shard> parse_shard(std::string_view text);

/// "3-of-8", as names have it.
std::string name_of(const Shard& shard);
/// Nothing but what name_of() gives: without leading zeros or signs.
std::optional<Shard> shard_named(std::string_view text);

}  // namespace pelagic::tools
