// Which frames an export has, what number each has in its name, and when it is.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pelagic::tools {

/// Frames `first` to `last`, both of them.
struct FrameRange {
    int first = 0, last = 0;

    std::size_t count() const { return static_cast<std::size_t>(last - first) + 1; }
    bool operator==(const FrameRange&) const = default;
};

struct FrameTimes {
    static constexpr int largest_number = 999'999;

    double start_s = 0;  ///< time of frame `start_number`
    int start_number = 0;
    std::vector<FrameRange> ranges = {{0, 0}};  ///< rising, apart, not empty
    std::optional<double> fps;                  ///< none: the frames are one loop
    double loop_period_s = 0;

    std::size_t count() const;
    /// Of the frame at a place in the export. \pre index < count()
    int number(std::size_t index) const;
    /// Those from place `begin` on, before place `end`. \pre begin <= end <= count()
    std::vector<int> numbers(std::size_t begin, std::size_t end) const;
    bool contains(int number) const;
    double time_of(int number) const {
        const int frame = number - start_number;
        return start_s + (fps ? frame / *fps : frame * (loop_period_s / static_cast<double>(count())));
    }
    /// They are `start_number` and those behind it, without a gap.
    bool is_one_run() const { return ranges.size() == 1 && ranges.front().first == start_number; }
};

/// "10-20,40", as parse_frame_ranges() takes it.
std::string text_of(const std::vector<FrameRange>& ranges);

/// "10-20,40" as {10, 20}, {40, 40}; none unless they rise and are apart, and each number is at most the largest.
std::optional<std::vector<FrameRange>> parse_frame_ranges(const std::string& text);

}  // namespace pelagic::tools
