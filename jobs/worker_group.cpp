#include "pelagic/jobs/worker_group.hpp"

#include <algorithm>
#include <cassert>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "pelagic/jobs/platform.hpp"
#include "pelagic/jobs/thread_count.hpp"

namespace pelagic {
namespace {

using Clock = std::chrono::steady_clock;

constexpr Clock::rep ticks_of_us(int us) { return Clock::duration(std::chrono::microseconds(us)).count(); }

/// First estimates, of a desktop processor that is idle.
constexpr Clock::rep usual_wake_cost = ticks_of_us(5), usual_wake_delay = ticks_of_us(40);

/// Runs that follow each other within the time of spinning are a series after this number. A paced
/// application has at most a few in a row, one for each of its graphs.
constexpr int runs_of_a_series = 8;

Clock::rep now() { return Clock::now().time_since_epoch().count(); }

/// Hints to the core that this thread spins.
void pause() {
#if defined(__x86_64__)
    _mm_pause();
#elif defined(__aarch64__)
    __asm__ __volatile__("yield");
#endif
}

/// Moves an estimate towards a sample. A thread that was preempted gives a sample that is much too
/// large, so that its weight is limited.
void adjust(std::atomic<Clock::rep>& estimate, Clock::rep sample) {
    const Clock::rep before = estimate;
    estimate = before == 0 ? sample : before + (std::min(sample, 2 * before) - before) / 8;
}

}  // namespace

class WorkerGroup::BoundRun final : public GraphRun {
   public:
    BoundRun(const JobGraph& graph, std::shared_ptr<WorkerGroup> group)
        : group_(std::move(group)), run_(std::make_shared<Run>(graph, group_->threads())) {
        const std::lock_guard lock(group_->mutex_);
        group_->runs_.push_back(run_);
    }
    ~BoundRun() override {
        group_->finish(*run_);
        const std::lock_guard lock(group_->mutex_);
        std::erase(group_->runs_, run_);
    }

    void schedule() override {
        assert(is_done() && "complete() the run before schedule()");
        group_->start(*run_);
    }
    void complete() override {
        group_->finish(*run_);
        run_->progress.rethrow_failure();
    }
    void run() override {
        assert(is_done() && "complete() the run before run()");
        group_->start_and_finish(*run_);
        run_->progress.rethrow_failure();
    }
    bool is_done() const override { return run_->progress.is_done(); }

   private:
    std::shared_ptr<WorkerGroup> group_;
    std::shared_ptr<Run> run_;
};

WorkerGroup::WorkerGroup(int threads)
    : threads_(threads), wake_cost_(usual_wake_cost), wake_delay_(usual_wake_delay) {
    set_spin_us(default_spin_us);
}

std::unique_ptr<GraphRun> WorkerGroup::prepare(const JobGraph& graph, std::shared_ptr<WorkerGroup> group) {
    return std::make_unique<BoundRun>(graph, std::move(group));
}

// More threads than cores would delay each other.
void WorkerGroup::set_spin_us(int us) { spin_ = threads_ <= cores() ? ticks_of_us(us) : 0; }

void WorkerGroup::start(Run& run) {
    run.wakes_workers = true;
    const std::size_t ready_blocks = run.progress.start();
    ++changes_;
    wake_for(ready_blocks);
}

void WorkerGroup::start_and_finish(Run& run) {
    const bool is_soon = now() - last_end_ < spin_;
    runs_in_a_row_ = is_soon ? runs_in_a_row_ + 1 : 0;
    run.wakes_workers = awake_ > 0 || pays_to_wake(run);
    const std::size_t ready_blocks = run.progress.start();
    ++changes_;
    if (run.wakes_workers)
        wake_for(ready_blocks - std::min(ready_blocks, std::size_t{1}));
    else
        // Without waking, the estimates would never be measured again. They decrease, so that a
        // worker is woken after some tens of runs.
        for (auto* const estimate : {&wake_cost_, &wake_delay_}) *estimate -= *estimate / 64;
    finish(run);
    last_end_ = now();
}

/// A worker that is woken does half of the work that remains when it begins. In a series of runs it
/// is awake from the second one on.
bool WorkerGroup::pays_to_wake(const Run& run) const {
    if (run.work == 0 || runs_in_a_row_ >= runs_of_a_series) return true;
    return run.work > wake_delay_ + 2 * wake_cost_;
}

void WorkerGroup::finish(Run& run) {
    RunProgress::Place place;
    Clock::rep busy = 0;
    std::size_t blocks = 0;
    for (;;) {
        const std::uint32_t seen = changes_;
        const Clock::rep start = now();
        if (const std::size_t done = work_while_ready(run, place)) {
            busy += now() - start;
            blocks += done;
            continue;
        }
        if (run.progress.is_done()) break;
        if (!spin_until_change(seen)) wait_while(changes_, seen);
    }
    if (blocks == 0) return;
    const double part = static_cast<double>(blocks) / static_cast<double>(run.progress.blocks());
    adjust(run.work, static_cast<Clock::rep>(static_cast<double>(busy) / part));
}

void WorkerGroup::work(int thread) noexcept {
    if (const Clock::rep woken_at = woken_at_.exchange(0)) adjust(wake_delay_, now() - woken_at);
    // Linux may wake a thread on the CPU of the waking thread, which is busy, and does so again
    // each time if the two CPUs share no cache.
    if (const int cpu = current_cpu(); cpu >= 0 && cpu == waking_cpu_) leave_cpu(cpu);
    RunProgress::Place place{thread};
    const Run* last = nullptr;
    std::uint32_t seen;
    do {
        seen = changes_;
    } while (work_on_all_runs(place, last) || stays_awake(seen));
}

/// \param place  of the thread in the run `last`, on which it has worked last
bool WorkerGroup::work_on_all_runs(RunProgress::Place& place, const Run*& last) noexcept {
    bool has_worked = false;
    std::size_t index = 0;
    while (const std::shared_ptr<Run> run = unfinished_run(index)) {
        if (run.get() != std::exchange(last, run.get())) place = {place.thread};
        has_worked |= work_while_ready(*run, place) > 0;
    }
    return has_worked;
}

/// Returns the next unfinished run from `index` on, and increments the index beyond it.
std::shared_ptr<WorkerGroup::Run> WorkerGroup::unfinished_run(std::size_t& index) noexcept {
    const std::lock_guard lock(mutex_);
    while (index < runs_.size())
        if (const std::shared_ptr<Run>& run = runs_[index++]; !run->progress.is_done()) return run;
    return {};
}

/// Works on one run until no block is ready. Returns the number of blocks that this thread ran.
std::size_t WorkerGroup::work_while_ready(Run& run, RunProgress::Place& place) noexcept {
    std::size_t blocks = 0;
    for (;;) {
        const RunProgress::Outcome outcome = run.progress.work(place);
        if (outcome.blocks == 0) return blocks;
        blocks += outcome.blocks;
        // This thread continues with one of the ready blocks. Only the thread that completes a run
        // waits for its end.
        if (outcome.ready_blocks <= 1 && (!outcome.is_last || place.thread == 0)) continue;
        ++changes_;
        wake_all(changes_);  // threads in finish(); a system call only if there are any
        if (outcome.ready_blocks > 1 && run.wakes_workers) wake_for(outcome.ready_blocks - 1);
    }
}

/// Wakes as many workers as can work on `blocks` blocks, except those that look for work already.
void WorkerGroup::wake_for(std::size_t blocks) noexcept {
    const int workers = threads_ - 1;
    if (awake_ >= workers) return;
    const int wanted = static_cast<int>(std::min(blocks, static_cast<std::size_t>(workers))) - spinning_;
    int count = 0;
    for (int awake = awake_; count < wanted && awake < workers;)
        if (awake_.compare_exchange_weak(awake, awake + 1)) ++count, ++awake;
    if (count <= 0) return;
    const Clock::rep start = now();
    woken_at_ = start;
    waking_cpu_ = current_cpu();
    awake_ -= count - wake(count);
    adjust(wake_cost_, now() - start);
}

/// Returns true if there is a change, or false after the time of spinning.
bool WorkerGroup::spin_until_change(std::uint32_t seen) const noexcept {
    const Clock::rep spin = spin_;
    if (spin == 0) return changes_ != seen;
    constexpr int pauses_per_clock_read = 8;
    for (const Clock::rep end = now() + spin; now() < end;)
        for (int i = 0; i < pauses_per_clock_read; ++i) {
            if (changes_ != seen) return true;
            pause();
        }
    return false;
}

/// Returns false if the thread must sleep, because there has been no change for a while.
///
/// A thread that changes something reads the numbers of workers afterwards. It therefore counts this
/// worker as asleep, or this worker reads the change.
bool WorkerGroup::stays_awake(std::uint32_t seen) noexcept {
    ++spinning_;
    spin_until_change(seen);
    --spinning_;
    if (changes_ != seen) return true;
    --awake_;
    if (changes_ == seen) return false;
    for (int awake = awake_; awake < threads_ - 1;)
        if (awake_.compare_exchange_weak(awake, awake + 1)) return true;
    return false;  // others have been woken instead
}

}  // namespace pelagic
