#include "pelagic/viewer/stage_times.hpp"

#include <algorithm>
#include <string_view>

namespace pelagic::viewer {
namespace {

/// Removes the cascade number, which ends the stage names of further cascades: "gradients+mipmaps
/// c2".
std::string_view without_cascade(std::string_view name) {
    const std::size_t number = name.find(" c");
    return number != name.npos && name.find_first_not_of("0123456789", number + 2) == name.npos
               ? name.substr(0, number)
               : name;
}

}  // namespace

void StageTimes::follow(const JobGraph& graph) {
    const std::lock_guard lock(mutex_);
    rows_.clear();
    for (const Stage& stage : graph.stages())
        if (std::ranges::find(rows_, without_cascade(stage.name), &Row::name) == rows_.end())
            rows_.push_back({.name = std::string(without_cascade(stage.name))});
    now_ms_.assign(rows_.size(), 0);
}

void StageTimes::work(const TraceSpan& span) noexcept {
    const double ms = std::chrono::duration<double, std::milli>(span.end - span.start).count();
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < rows_.size(); ++i)
        if (rows_[i].name == without_cascade(span.name)) now_ms_[i] += ms;
}

void StageTimes::end_frame() {
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < rows_.size(); ++i) {
        std::rotate(rows_[i].ms.begin(), rows_[i].ms.begin() + 1, rows_[i].ms.end());
        rows_[i].ms.back() = static_cast<float>(now_ms_[i]);
        now_ms_[i] = 0;
    }
}

}  // namespace pelagic::viewer
