#include "pelagic/jobs/sharing_choice.hpp"

#include <algorithm>

namespace pelagic {

void SharingChoice::count(std::int64_t time, std::int64_t alone) {
    constexpr std::int64_t max_alone_ns = 1'000'000;  // waking threads takes up to 0.2 ms
    if (alone > max_alone_ns) return;
    runs_ = std::min(runs_ + 1, max_patience);
    if (runs_ <= warm_runs) return;
    std::int64_t& mine = shares_ ? shared_ : alone_;
    if (runs_ == warm_runs + 1)
        mine = time;
    else if (runs_ <= trial_runs)
        mine = std::min(mine, time);
    else  // follows the lower quartile, as the least of four does, and limits the weight of one run
        mine += time < mine ? (time - mine) / 8 : std::min(time - mine, mine / 2) / 24;
    has_run_alone_ |= !shares_;
    // A thread that shares its work with another one takes up to 1.5 times as long for a block,
    // because data are in the other's cache.
    if (!has_run_alone_) alone_ = alone - alone / 3;
    if (runs_ < trial_runs) return;

    const bool is_better = (alone_ > shared_ + shared_ / 9) == shares_;
    if (is_trial_) {
        is_trial_ = false;
        patience_ = is_better ? min_patience : std::min(2 * patience_, max_patience);
        if (!is_better) change(false);
    } else if (!is_better || (runs_ >= patience_ && !(shares_ && alone_ > 2 * shared_))) {
        change(true);
    }
}

void SharingChoice::change(bool is_trial) {
    shares_ = !shares_;
    is_trial_ = is_trial;
    runs_ = 0;
}

}  // namespace pelagic
