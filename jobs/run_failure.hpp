// What went wrong in a run, kept until complete() can tell.
#pragma once

#include <atomic>
#include <exception>
#include <utility>

namespace pelagic {

/// The first exception of a run. An exception may leave neither a worker thread nor an application's job, and the other blocks
/// of the run use the same memory: so it is kept, the run goes on to its end, and complete() throws it.
class RunFailure {
   public:
    /// The exception that is being handled. From any thread, before its block counts as done.
    void keep_current() noexcept { keep(std::current_exception()); }

    void keep(std::exception_ptr failure) noexcept {
        if (!is_kept_.exchange(true)) failure_ = std::move(failure);
    }

    /// Throws what was kept, once; nothing if nothing was. \pre the run is over
    void rethrow() {
        if (!is_kept_) return;
        const std::exception_ptr failure = std::exchange(failure_, nullptr);
        is_kept_ = false;
        std::rethrow_exception(failure);
    }

   private:
    std::atomic<bool> is_kept_ = false;
    std::exception_ptr failure_;
};

}  // namespace pelagic
