#include "pelagic/tools/export/frame_times.hpp"

#include <algorithm>

#include "pelagic/tools/text/option_text.hpp"

namespace pelagic::tools {
namespace {

std::optional<int> frame_number(const std::string& text) {
    const auto number = parse_integer(text);
    if (!number || *number < 0 || *number > FrameTimes::largest_number) return {};
    return static_cast<int>(*number);
}

}  // namespace

std::size_t FrameTimes::count() const {
    std::size_t count = 0;
    for (const FrameRange& range : ranges) count += range.count();
    return count;
}

int FrameTimes::number(std::size_t index) const {
    for (const FrameRange& range : ranges) {
        if (index < range.count()) return range.first + static_cast<int>(index);
        index -= range.count();
    }
    return ranges.back().last;
}

std::vector<int> FrameTimes::numbers(std::size_t begin, std::size_t end) const {
    std::vector<int> numbers;
    std::size_t place = 0;
    for (const FrameRange& range : ranges) {
        const std::size_t behind = place + range.count();
        for (std::size_t i = std::max(begin, place); i < std::min(end, behind); ++i)
            numbers.push_back(range.first + static_cast<int>(i - place));
        place = behind;
    }
    return numbers;
}

bool FrameTimes::contains(int number) const {
    const auto range =
        std::partition_point(ranges.begin(), ranges.end(), [&](const FrameRange& one) { return one.last < number; });
    return range != ranges.end() && range->first <= number;
}

std::string text_of(const std::vector<FrameRange>& ranges) {
    std::string text;
    for (const FrameRange& range : ranges) {
        if (!text.empty()) text += ",";
        text += std::to_string(range.first);
        if (range.last > range.first) text += "-" + std::to_string(range.last);
    }
    return text;
}

std::optional<std::vector<FrameRange>> parse_frame_ranges(const std::string& text) {
    std::vector<FrameRange> ranges;
    for (const std::string& piece : split_at_commas(text)) {
        const std::size_t dash = piece.find('-');
        const auto first = frame_number(piece.substr(0, dash));
        const auto last = dash == std::string::npos ? first : frame_number(piece.substr(dash + 1));
        if (!first || !last || *last < *first || (!ranges.empty() && *first <= ranges.back().last)) return {};
        ranges.push_back({*first, *last});
    }
    return ranges;
}

}  // namespace pelagic::tools
