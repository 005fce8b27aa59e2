// Frame numbers and times of an export.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pelagic::tools {

/// Frames `first` to `last`, inclusive.
struct FrameRange {
    int first = 0, last = 0;

    std::size_t count() const { return static_cast<std::size_t>(last - first) + 1; }
    bool operator==(const FrameRange&) const = default;
};

struct FrameTimes {
    static constexpr int largest_number = 999'999;

    double start_s = 0;  ///< time of frame `start_number`
    int start_number = 0;
    std::vector<FrameRange> ranges = {{0, 0}};  ///< ascending, disjoint, not empty
    std::optional<double> fps;                  ///< none: the frames span one loop
    double loop_period_s = 0;

    std::size_t count() const;
    /// Returns the number of the frame at an index.
    /// \pre index < count()
    int number(std::size_t index) const;
    /// Returns the numbers of the frames at indices [begin, end).
    /// \pre begin <= end <= count()
    std::vector<int> numbers(std::size_t begin, std::size_t end) const;
    bool contains(int number) const;
    double time_of(int number) const {
        const int frame = number - start_number;
        return start_s + (fps ? frame / *fps : frame * (loop_period_s / static_cast<double>(count())));
    }
    /// Returns true if the numbers start at `start_number` and have no gap.
    bool is_one_run() const { return ranges.size() == 1 && ranges.front().first == start_number; }
};

/// Returns "10-20,40", the format of parse_frame_ranges().
std::string text_of(const std::vector<FrameRange>& ranges);

/// Parses "10-20,40" as {10, 20}, {40, 40}. Returns none unless the ranges are ascending and
/// disjoint, and every number is at most largest_number.
std::optional<std::vector<FrameRange>> parse_frame_ranges(const std::string& text);

}  // namespace pelagic::tools
