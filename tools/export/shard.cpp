#include "pelagic/tools/export/shard.hpp"

#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

std::optional<Shard> parsed_shard(std::string_view text, std::string_view between) {
    const std::size_t middle = text.find(between);
    if (middle == std::string_view::npos) return {};
    const auto index = parse_integer(text.substr(0, middle));
    const auto count = parse_integer(text.substr(middle + between.size()));
    if (!index || !count || *count < 1 || *count > Shard::max_count || *index < 1 || *index > *count) return {};
    return Shard{static_cast<int>(*index), static_cast<int>(*count)};
}

std::string written(const Shard& shard, const char* between) {
    return std::to_string(shard.index) + between + std::to_string(shard.count);
}

/// A name that contains a shard between two fixed texts.
struct NameAroundShard {
    std::string_view before, after;

    std::string of(const std::optional<Shard>& shard) const {
        return std::string(before).append(shard ? "." + mark_of(*shard) : "").append(after);
    }
    std::optional<Shard> shard_in(std::string_view name) const {
        if (!name.starts_with(before) || !name.ends_with(after) || name.size() <= before.size() + after.size())
            return {};
        name = name.substr(before.size(), name.size() - before.size() - after.size());
        return name.starts_with('.') ? shard_named(name.substr(1)) : std::nullopt;
    }
};

constexpr NameAroundShard record_files{"sea", ".json"}, journal_files{".pelagic-export", ".jsonl"},
    lock_files{".sea", ".lock"};

}  // namespace

std::string text_of(const Shard& shard) { return written(shard, "/"); }
std::string mark_of(const Shard& shard) { return written(shard, "-of-"); }

std::optional<Shard> parse_shard(std::string_view text) { return parsed_shard(text, "/"); }

std::optional<Shard> shard_named(std::string_view text) {
    const std::optional<Shard> shard = parsed_shard(text, "-of-");
    return shard && mark_of(*shard) == text ? shard : std::nullopt;
}

std::string record_name(const std::optional<Shard>& shard) {
    return shard ? record_files.of(shard) : "sea_files.json";
}
std::string journal_name(const std::optional<Shard>& shard) { return journal_files.of(shard); }
std::string lock_name_of(const Shard& shard) { return lock_files.of(shard); }

std::optional<Shard> shard_of_record(std::string_view name) { return record_files.shard_in(name); }

bool is_of_shard(std::string_view name) {
    return record_files.shard_in(name) || journal_files.shard_in(name) || lock_files.shard_in(name);
}

bool is_record_name(std::string_view name) {
    return name == sea_json_name || name == record_name({}) || name == journal_name({}) || name == lock_name ||
           is_of_shard(name);
}

}  // namespace pelagic::tools
