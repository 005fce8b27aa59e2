#include "pelagic/viewer/stage_times.hpp"

#include <algorithm>

namespace pelagic::viewer {

void StageTimes::follow(const JobGraph& graph) {
    const std::lock_guard lock(mutex_);
    rows_.clear();
    for (const Stage& stage : graph.stages()) rows_.push_back({.name = stage.name});
    now_ms_.assign(rows_.size(), 0);
}

void StageTimes::work(const TraceSpan& span) noexcept {
    const double ms = std::chrono::duration<double, std::milli>(span.end - span.start).count();
    const std::lock_guard lock(mutex_);
    for (std::size_t i = 0; i < rows_.size(); ++i)
        if (rows_[i].name == span.name) now_ms_[i] += ms;
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
