#include "pelagic/jobs/job_thread.hpp"

#include <algorithm>
#include <atomic>
#include <cassert>
#include <cstdint>
#include <string>
#include <system_error>
#include <thread>
#include <utility>
#include <vector>

#include "pelagic/jobs/platform.hpp"
#include "pelagic/message/number_text.hpp"

#if __has_include(<pthread.h>)
#include <pthread.h>
#define PELAGIC_HAS_PTHREADS
#endif

namespace pelagic {

#if defined(PELAGIC_HAS_PTHREADS)

// std::thread has no parameter for the stack size, so POSIX threads are used.
struct JobThread::Handle {
    Handle(std::function<void()> wanted, std::size_t stack_bytes) : work(std::move(wanted)) {
        pthread_attr_t attributes;
        int error = pthread_attr_init(&attributes);
        if (error == 0) {
            error = pthread_attr_setstacksize(&attributes, std::max(stack_bytes, min_stack_bytes()));
            if (error == 0) error = pthread_create(&thread, &attributes, &run, this);
            pthread_attr_destroy(&attributes);
        }
        if (error != 0) throw std::system_error(error, std::generic_category());
    }
    void join() { pthread_join(thread, nullptr); }

    static void* run(void* handle) {
        static_cast<Handle*>(handle)->work();
        return nullptr;
    }

    std::function<void()> work;
    pthread_t thread{};
};

#else

struct JobThread::Handle {
    Handle(std::function<void()> work, std::size_t) : thread(std::move(work)) {}
    void join() { thread.join(); }
    std::thread thread;
};

#endif

JobThread::JobThread(std::function<void()> work, std::size_t stack_bytes)
    : handle_(std::make_unique<Handle>(std::move(work), stack_bytes)) {}
JobThread::JobThread(JobThread&&) noexcept = default;
JobThread::~JobThread() { assert(!handle_); }

void JobThread::join() {
    handle_->join();
    handle_.reset();
}

void need_threads(int count, std::size_t stack_bytes) {
    std::atomic<std::uint32_t> is_released = 0;
    std::vector<JobThread> threads;
    threads.reserve(static_cast<std::size_t>(std::max(count - 1, 0)));
    const auto join = [&] {
        is_released = 1;
        wake_all(is_released);
        for (JobThread& thread : threads) thread.join();
    };
    try {
        for (int i = 1; i < count; ++i) threads.emplace_back([&] { wait_while(is_released, 0); }, stack_bytes);
    } catch (const std::system_error& error) {
        join();
        throw std::system_error(error.code(), number_text(count) +
                                                  " threads are requested, but the system provides " +
                                                  number_text(threads.size() + 1));
    } catch (...) {  // no memory for a thread's data
        join();
        throw;
    }
    join();
}

}  // namespace pelagic
