// A minimal application job system: one thread for submitted tasks, and a second one for each
// parallel loop.
#pragma once

#include <atomic>
#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/tests/each_executor.hpp"

namespace pelagic {

class TestApplication {
   public:
    TestApplication() : worker_([this] { work(); }) {}
    ~TestApplication() {
        {
            const std::lock_guard lock(mutex_);
            stopping_ = true;
        }
        changed_.notify_one();
        worker_.join();
    }

    ApplicationJobs jobs() { return {.user = this, .parallel_for = parallel_for, .submit = submit, .threads = 2}; }

   private:
    static void parallel_for(void*, std::size_t count, void (*job)(void*, std::size_t), void* work) {
        std::atomic<std::size_t> next = 0;
        const auto take = [&] {
            for (std::size_t i = next++; i < count; i = next++) job(work, i);
        };
        std::thread other(take);
        take();
        other.join();
    }

    static void submit(void* user, void (*task)(void*), void* work) {
        auto* const application = static_cast<TestApplication*>(user);
        {
            const std::lock_guard lock(application->mutex_);
            application->tasks_.emplace_back(task, work);
        }
        application->changed_.notify_one();
    }

    void work() {
        std::unique_lock lock(mutex_);
        for (;;) {
            changed_.wait(lock, [this] { return stopping_ || !tasks_.empty(); });
            if (tasks_.empty()) return;
            const auto [task, argument] = tasks_.front();
            tasks_.pop_front();
            lock.unlock();
            task(argument);
            lock.lock();
        }
    }

    std::mutex mutex_;
    std::condition_variable changed_;
    std::deque<std::pair<void (*)(void*), void*>> tasks_;
    bool stopping_ = false;
    std::thread worker_;
};

struct Application {
    std::string name;
    std::shared_ptr<Executor> executor;
};

/// Returns the jobs of an application and every executor; under an emulator only the first.
inline std::vector<Application> applications() {
    static TestApplication own;
    std::vector<Application> all = {{"application", make_callback_executor(own.jobs())}};
    for (const ExecutorKind& kind : executor_kinds())
        if (!is_emulated || all.size() < 2) all.push_back({kind.name, kind.make(kind.threads)});
    return all;
}

}  // namespace pelagic
