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

}  // namespace

std::string text_of(const Shard& shard) { return written(shard, "/"); }
std::string mark_of(const Shard& shard) { return written(shard, "-of-"); }

std::optional<Shard> parse_shard(std::string_view text) { return parsed_shard(text, "/"); }

std::optional<Shard> shard_named(std::string_view text) {
    const std::optional<Shard> shard = parsed_shard(text, "-of-");
    return shard && mark_of(*shard) == text ? shard : std::nullopt;
}

}  // namespace pelagic::tools
