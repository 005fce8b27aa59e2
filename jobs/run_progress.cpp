#include "pelagic/jobs/run_progress.hpp"

#include <algorithm>

namespace pelagic {

RunProgress::RunProgress(const JobGraph& graph, int threads)
    : graph_(graph), threads_(static_cast<std::size_t>(threads)), stages_(graph.stages().size()) {
    for (StageId id = 0; id < stages_.size(); ++id) {
        const Stage& stage = graph.stages()[id];
        if (stage.waits_for.empty()) first_stages_.push_back(id);
        for (const StageId earlier : stage.waits_for) stages_[earlier].followers.push_back(id);
        State& state = stages_[id];
        state.blocks = block_count(stage);
        state.ranges = std::vector<Range>(std::min(state.blocks, static_cast<std::size_t>(threads)));
        std::size_t begin = 0;
        for (std::size_t i = 0; i < state.ranges.size(); ++i) {
            Range& range = state.ranges[i];
            range.begin = begin;
            range.next = range.end = begin += (state.blocks - begin) / (state.ranges.size() - i);
        }
    }
}

std::size_t RunProgress::start() {
    for (StageId id = 0; id < stages_.size(); ++id) {
        stages_[id].waiting_for = graph_.stages()[id].waits_for.size();
        stages_[id].remaining_blocks = stages_[id].blocks;
    }
    remaining_stages_ = stages_.size();
    Outcome outcome;
    for (const StageId id : first_stages_) make_ready(id, outcome);
    return outcome.ready_blocks;
}

RunProgress::Place RunProgress::first_place(int thread) const {
    if (first_stages_.empty()) return {thread};
    const std::size_t number = static_cast<std::size_t>(thread) * first_stages_.size() / threads_;
    return {thread, first_stages_[number % first_stages_.size()]};
}

RunProgress::Outcome RunProgress::work(Place& place) noexcept {
    if (is_done()) return {};
    StageId id = place.stage;
    for (std::size_t i = 0; i < stages_.size(); ++i) {
        if (const std::size_t done = run_blocks(id, place.thread)) {
            place.stage = id;
            Outcome outcome{.has_worked = true};
            if (stages_[id].remaining_blocks.fetch_sub(done) == done) end_stage(id, outcome);
            return outcome;
        }
        if (++id == stages_.size()) id = 0;
    }
    return {};
}

/// Runs blocks of a stage, of the thread's range first. Returns their number, which the caller must
/// subtract from the remaining blocks; the stage cannot end before.
///
/// A range has no blocks to take until make_ready() resets its counter. A thread that is late and
/// increments the counter of a later run takes a block that is ready in that run.
std::size_t RunProgress::run_blocks(StageId id, int thread) noexcept {
    std::vector<Range>& ranges = stages_[id].ranges;
    std::size_t done = 0;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        Range& range = ranges[(static_cast<std::size_t>(thread) + i) % ranges.size()];
        while (range.next.load(std::memory_order_relaxed) < range.end) {
            const std::size_t block = range.next.fetch_add(1);
            if (block >= range.end) break;
            try {
                run_block(graph_.stages()[id], block);
            } catch (...) {
                failure_.keep_current();
            }
            ++done;
        }
    }
    return done;
}

void RunProgress::make_ready(StageId id, Outcome& outcome) {
    State& stage = stages_[id];
    if (stage.blocks == 0) return end_stage(id, outcome);
    outcome.ready_blocks += stage.blocks;
    for (Range& range : stage.ranges) range.next = range.begin;
}

/// After the last stage, the run may start again at any time.
void RunProgress::end_stage(StageId id, Outcome& outcome) {
    for (const StageId follower : stages_[id].followers)
        if (stages_[follower].waiting_for.fetch_sub(1) == 1) make_ready(follower, outcome);
    if (remaining_stages_.fetch_sub(1) == 1) outcome.is_last = true;
}

}  // namespace pelagic
