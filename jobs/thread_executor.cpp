// A pool of threads that sleep until there is work.
#include <algorithm>
#include <atomic>
#include <string>
#include <system_error>
#include <thread>
#include <vector>

#include "pelagic/jobs/cpu_mask.hpp"
#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/job_thread.hpp"
#include "pelagic/jobs/platform.hpp"
#include "pelagic/jobs/thread_count.hpp"
#include "pelagic/jobs/worker_group.hpp"
#include "pelagic/message/number_text.hpp"

namespace pelagic {
namespace {

class Pool final : public WorkerGroup {
   public:
    Pool(int threads, std::uint64_t cpu_mask) : WorkerGroup(threads) {
        threads_.reserve(static_cast<std::size_t>(threads));
        try {
            for (int thread = 1; thread < threads; ++thread)
                threads_.emplace_back([this, cpu_mask, thread] {
                    keep_this_thread_on(cpu_mask);
                    while (sleep()) work(thread);
                });
        } catch (const std::system_error& error) {
            const std::size_t given = threads_.size() + 1;
            stop();
            throw std::system_error(
                error.code(),
                number_text(threads) + " threads are requested, but the system provides " + number_text(given));
        } catch (...) {  // no memory for a thread's data
            stop();
            throw;
        }
    }
    ~Pool() override { stop(); }

   private:
    bool owns_threads() const noexcept override { return true; }
    int wake(int count) noexcept override {
        wakes_ += static_cast<std::uint32_t>(count);
        for (int i = 0; i < count; ++i) wake_one(wakes_);
        return count;
    }

    /// Returns true when the thread is woken to work, or false if it must end.
    bool sleep() {
        for (std::uint32_t wakes = wakes_; !is_stopping_;) {
            if (wakes == 0) {
                wait_while(wakes_, 0);
                wakes = wakes_;
            } else if (wakes_.compare_exchange_weak(wakes, wakes - 1)) {
                return !is_stopping_;
            }
        }
        return false;
    }

    void stop() {
        is_stopping_ = true;
        wakes_ += static_cast<std::uint32_t>(threads_.size());
        wake_all(wakes_);
        for (JobThread& thread : threads_) thread.join();
    }

    std::atomic<std::uint32_t> wakes_ = 0;  ///< number of threads to wake
    std::atomic<bool> is_stopping_ = false;
    std::vector<JobThread> threads_;
};

class ThreadExecutor final : public Executor {
   public:
    ThreadExecutor(int threads, std::uint64_t cpu_mask) : pool_(std::make_shared<Pool>(threads, cpu_mask)) {}
    std::unique_ptr<GraphRun> prepare(const JobGraph& graph) override { return WorkerGroup::prepare(graph, pool_); }
    int thread_limit() const override { return pool_->threads(); }
    std::string_view name() const override { return "thread"; }
    void set_spin_us(int us) override { pool_->set_spin_us(checked_spin_us(us)); }

   private:
    std::shared_ptr<Pool> pool_;
};

}  // namespace

std::shared_ptr<Executor> make_thread_executor(int threads) { return make_thread_executor_on(0, threads); }

std::shared_ptr<Executor> make_thread_executor_on(std::uint64_t cpu_mask, int threads) {
    int cpus = default_thread_count();
    // The calling thread may work on a CPU outside of the mask.
    if (cpu_mask != 0) cpus = std::min(cpus, checked_cpus(cpu_mask) + (threads != 0));
    return std::make_shared<ThreadExecutor>(checked_thread_count(threads, cpus), cpu_mask);
}

}  // namespace pelagic
