#include "pelagic/tools/record/frames_of_record.hpp"

#include <optional>
#include <utility>
#include <vector>

namespace pelagic::tools {

std::string read_frames(const OutputFolder& folder, const std::string& name, const ExportOptions& options,
                        Places places, const std::function<void(const ReadJson& head)>& head,
                        const std::function<void(std::size_t place, FrameRecord&& frame)>& take) {
    const std::vector<int> numbers = options.times.numbers(places.begin, places.end);
    std::size_t next = 0;
    std::string wrong;
    const auto check_head = [&](const ReadJson& json) {
        head(json);
        return true;
    };
    const auto take_entry = [&](const ReadJson& entry) {
        if (next == numbers.size()) {
            wrong = " has more than its " + std::to_string(numbers.size()) + " frames";
            return false;
        }
        std::optional<FrameRecord> frame = accepted_frame(entry, options);
        if (!frame || frame->frame != numbers[next]) {
            wrong = " does not say of frame " + std::to_string(numbers[next]) + " what an export writes of it";
            return false;
        }
        take(places.begin + next, std::move(*frame));
        ++next;
        return true;
    };
    try {
        if (!read_record(folder, name, {.head = check_head, .frame = take_entry})) return " is missing";
    } catch (const DamagedRecord&) {
        return " is damaged";
    }
    if (wrong.empty() && next < numbers.size())
        return " ends before frame " + std::to_string(numbers[next]) + ", of " + std::to_string(numbers.size()) +
               " frames";
    return wrong;
}

}  // namespace pelagic::tools
