#include "pelagic/jobs/worker_group.hpp"

#include <algorithm>
#include <cassert>
#include <thread>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "pelagic/jobs/platform.hpp"
#include "pelagic/jobs/thread_count.hpp"

namespace pelagic {
namespace {

using Clock = std::chrono::steady_clock;

constexpr Clock::rep ticks_of_us(int us) { return Clock::duration(std::chrono::microseconds(us)).count(); }

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
        group_->start(*run_, 0);
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

WorkerGroup::WorkerGroup(int threads) : threads_(threads) { set_spin_us(default_spin_us); }

std::unique_ptr<GraphRun> WorkerGroup::prepare(const JobGraph& graph, std::shared_ptr<WorkerGroup> group) {
    return std::make_unique<BoundRun>(graph, std::move(group));
}

// More threads than CPUs, as tests have, would delay each other.
void WorkerGroup::set_spin_us(int us) { spin_ = threads_ <= default_thread_count() ? ticks_of_us(us) : 0; }

/// \param blocks_of_this_thread  blocks that need no worker, because this thread runs them
void WorkerGroup::start(Run& run, std::size_t blocks_of_this_thread) {
    const std::size_t ready_blocks = run.progress.start();
    ++changes_;
    wake_for(ready_blocks - std::min(ready_blocks, blocks_of_this_thread));
}

void WorkerGroup::start_and_finish(Run& run) {
    const Clock::rep start_time = now();
    runs_in_a_row_ = start_time - last_end_ < spin_ ? runs_in_a_row_ + 1 : 0;
    // In a series of runs a worker stays awake.
    SharingChoice& choice = awake_ > 0 || runs_in_a_row_ >= runs_of_a_series ? run.in_series : run.paced;
    Clock::rep alone = 0;
    if (threads_ > 1 && choice.shares()) {
        start(run, 1);
        alone = finish(run);
    } else {
        run.progress.run_alone();
    }
    last_end_ = now();
    choice.count(last_end_ - start_time, alone);
}

/// Returns an estimate of the time on one thread, from the part of this thread.
WorkerGroup::Clock::rep WorkerGroup::finish(Run& run) {
    RunProgress::Place place;
    Clock::rep busy = 0;
    std::size_t blocks = 0;
    for (;;) {
        const std::uint32_t seen = changes_;
        const Clock::rep start_time = now();
        if (const std::size_t done = work_while_ready(run, place)) {
            busy += now() - start_time;
            blocks += done;
            continue;
        }
        if (run.progress.is_done()) break;
        if (!spin_until_change(seen)) wait_while(changes_, seen);
    }
    return static_cast<Clock::rep>(static_cast<double>(busy) * static_cast<double>(run.progress.blocks()) /
                                   static_cast<double>(std::max(blocks, std::size_t{1})));
}

void WorkerGroup::work(int thread) noexcept {
    // Linux may wake a thread on the CPU of the waking thread, which is busy, and does so again
    // each time if the two CPUs share no cache. The thread then waits for 2 ms, so it stays away.
    // A thread that others use as well may run there later, so it leaves now, and the waking thread
    // yields next time to let it leave.
    const int cpu = current_cpu();
    const bool is_in_the_way = cpu >= 0 && cpu == waking_cpu_;
    if (is_in_the_way) leave_cpu(cpu, owns_threads());
    yields_after_waking_ = is_in_the_way && !owns_threads();
    RunProgress::Place place{thread};
    std::shared_ptr<Run> last;
    std::uint32_t seen;
    do {
        seen = changes_;
    } while (work_on_all_runs(place, last, seen) || stays_awake(seen));
}

/// Runs that were bound earlier take precedence, for instance frames before spectra of later seas.
/// A change therefore interrupts work on the others.
/// \param place  of the thread in the run `last`, on which it has worked last
/// \param seen   value of changes_
bool WorkerGroup::work_on_all_runs(RunProgress::Place& place, std::shared_ptr<Run>& last,
                                   std::uint32_t seen) noexcept {
    const RunProgress::Interrupt interrupt{changes_, seen};
    bool has_worked = false;
    std::size_t index = 0;
    while (const std::shared_ptr<Run> run = unfinished_run(index)) {
        if (run != last) place = {place.thread};
        last = run;
        const bool is_first = index == 1;
        has_worked |= work_while_ready(*run, place, is_first ? nullptr : &interrupt) > 0;
        if (has_worked && !is_first && interrupt.has_come()) break;
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

/// Works on one run until no block is ready, or until a change interrupts it. Returns the number of
/// blocks that this thread ran.
std::size_t WorkerGroup::work_while_ready(Run& run, RunProgress::Place& place,
                                          const RunProgress::Interrupt* interrupt) noexcept {
    std::size_t blocks = 0;
    while (!(blocks > 0 && interrupt && interrupt->has_come())) {
        const RunProgress::Outcome outcome = run.progress.work(place, interrupt);
        if (outcome.blocks == 0) return blocks;
        blocks += outcome.blocks;
        // This thread continues with one of the ready blocks. Only the thread that completes a run
        // waits for its end.
        if (outcome.ready_blocks <= 1 && (!outcome.is_last || place.thread == 0)) continue;
        ++changes_;
        wake_all(changes_);  // threads in finish(); a system call only if there are any
        if (outcome.ready_blocks > 1) wake_for(outcome.ready_blocks - 1);
    }
    return blocks;
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
    waking_cpu_ = current_cpu();
    awake_ -= count - wake(count);
    if (yields_after_waking_) std::this_thread::yield();
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
/// A thread that changes something reads the numbers of workers afterwards. It therefore counts
/// this worker as asleep, or this worker reads the change.
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
