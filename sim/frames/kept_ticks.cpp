#include "pelagic/sim/frames/kept_ticks.hpp"

#include <algorithm>
#include <utility>

namespace pelagic {

void KeptTicks::begin_frame(double time_s) {
    frame_tick_ = clock().at(time_s);
    const std::int64_t all = options_.count;
    std::int64_t ahead = all;
    if (newest_) {
        ahead = frame_tick_.number - *newest_;
        if (options_.repeats && weather_.forecast().changes.empty()) ahead = clock().in_loop(ahead);
    }
    set_due(static_cast<int>(ahead < 0 ? all : std::min(ahead, all)));
}

std::int64_t KeptTicks::begin_tick() {
    newest_ = frame_tick_.number - (due_.count - 1);
    set_due(due_.count - 1);
    return *newest_;
}

void KeptTicks::end() {
    if (std::exchange(ends_with_frame_, false)) forget();
}

void KeptTicks::drop() {
    due_.count = 0;
    ends_with_frame_ = false;
}

void KeptTicks::before_change(const SeaChange& next) {
    const bool is_due = due_.count > 0;  // ticks of a frame in flight
    if (!is_due && !newest_) return;
    const std::int64_t newest = is_due ? frame_tick_.number : *newest_;
    const double oldest_s = clock().time_s(newest - options_.count);
    if (clock().time_s(newest) <= next.from_s && oldest_s >= weather_.end_of_forgotten_by_next()) return;
    if (is_due)
        ends_with_frame_ = true;
    else
        forget();
}

/// Waves of a tick are those of its time in the loop, so that the part repeats with the loop.
void KeptTicks::set_due(int count) {
    const std::int64_t next = frame_tick_.number - count + 1;
    due_ = {count, clock().time_s(next), clock().time_in_loop_s(next), options_.whitecaps_only};
}

}  // namespace pelagic
