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
        blocks_ += state.blocks;
        state.ranges = std::vector<Range>(std::min(state.blocks, static_cast<std::size_t>(threads)));
        std::size_t begin = 0;
        for (std::size_t i = 0; i < state.ranges.size(); ++i) {
            Range& range = state.ranges[i];
            range.begin = begin;
            range.next = range.end = begin += (state.blocks - begin) / (state.ranges.size() - i);
        }
    }
    for (const State& state : stages_) ends_ += state.followers.empty();
}

std::size_t RunProgress::start() {
    for (StageId id = 0; id < stages_.size(); ++id) {
        stages_[id].waiting_for.store(graph_.stages()[id].waits_for.size(), std::memory_order_relaxed);
        stages_[id].remaining_blocks.store(stages_[id].blocks, std::memory_order_relaxed);
    }
    number_.store(number_ + 1, std::memory_order_relaxed);
    unfinished_ends_.store(ends_, std::memory_order_release);
    Outcome outcome;
    for (const StageId id : first_stages_) make_ready(id, outcome);
    return outcome.ready_blocks;
}

void RunProgress::run_alone() noexcept {
    unfinished_ends_.store(ends_, std::memory_order_relaxed);
    for (StageId id = 0; id < stages_.size(); ++id)
        for (std::size_t block = 0; block < stages_[id].blocks; ++block) run(id, block);
    unfinished_ends_.store(0, std::memory_order_release);
}

StageId RunProgress::first_stage(int thread) const {
    return first_stages_[static_cast<std::size_t>(thread) * first_stages_.size() / threads_];
}

RunProgress::Outcome RunProgress::work(Place& place, const Interrupt* interrupt) noexcept {
    if (is_done()) return {};
    if (const std::uint32_t number = number_.load(std::memory_order_relaxed); place.number != number)
        place = {place.thread, number, first_stage(place.thread)};
    StageId id = place.stage;
    for (std::size_t i = 0; i < stages_.size(); ++i) {
        const std::size_t next = id + 1 == stages_.size() ? 0 : id + 1;
        if (const std::size_t blocks = run_blocks(id, place.thread, interrupt)) {
            place.stage = interrupt && interrupt->has_come() ? id : next;
            Outcome outcome{.blocks = blocks};
            if (stages_[id].remaining_blocks.fetch_sub(blocks, std::memory_order_acq_rel) == blocks)
                end_stage(id, outcome);
            return outcome;
        }
        id = next;
    }
    return {};
}

/// Runs blocks of a stage, of the thread's range first. Returns their number, which the caller must
/// subtract from the remaining blocks; the stage cannot end before.
///
/// A range has no blocks to take until make_ready() resets its counter. A thread that is late and
/// increments the counter of a later run takes a block that is ready in that run.
std::size_t RunProgress::run_blocks(StageId id, int thread, const Interrupt* interrupt) noexcept {
    std::vector<Range>& ranges = stages_[id].ranges;
    std::size_t done = 0;
    for (std::size_t i = 0; i < ranges.size(); ++i) {
        Range& range = ranges[(static_cast<std::size_t>(thread) + i) % ranges.size()];
        while (range.next.load(std::memory_order_relaxed) < range.end) {
            const std::size_t block = range.next.fetch_add(1, std::memory_order_acquire);
            if (block >= range.end) break;
            run(id, block);
            ++done;
            if (interrupt && interrupt->has_come()) return done;
        }
    }
    return done;
}

void RunProgress::run(StageId id, std::size_t block) noexcept {
    try {
        run_block(graph_.stages()[id], block);
    } catch (...) {
        failure_.keep_current();
    }
}

void RunProgress::make_ready(StageId id, Outcome& outcome) {
    State& stage = stages_[id];
    if (stage.blocks == 0) return end_stage(id, outcome);
    outcome.ready_blocks += stage.blocks;
    for (Range& range : stage.ranges) range.next.store(range.begin, std::memory_order_release);
}

/// After the last stage, the run may start again at any time.
void RunProgress::end_stage(StageId id, Outcome& outcome) {
    if (stages_[id].followers.empty()) {
        if (unfinished_ends_.fetch_sub(1, std::memory_order_acq_rel) == 1) outcome.is_last = true;
        return;
    }
    for (const StageId follower : stages_[id].followers)
        if (graph_.stages()[follower].waits_for.size() == 1 ||
            stages_[follower].waiting_for.fetch_sub(1, std::memory_order_acq_rel) == 1)
            make_ready(follower, outcome);
}

}  // namespace pelagic
