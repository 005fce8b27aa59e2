// Storage of a run's first exception until complete() throws it.
#pragma once

#include <atomic>
#include <exception>
#include <utility>

namespace pelagic {

/// The first exception of a run. An exception must leave neither a worker thread nor an
/// application's job, and other blocks of the run use the same memory. The exception is therefore
/// stored, the run continues to its end, and complete() throws it.
class RunFailure {
   public:
    /// Stores the exception that is being handled. Thread safety: any thread may call it, before
    /// its block counts as done.
    void keep_current() noexcept { keep(std::current_exception()); }

    void keep(std::exception_ptr failure) noexcept {
        if (!is_kept_.exchange(true)) failure_ = std::move(failure);
    }

    /// Throws the stored exception, if there is one, and clears it. \pre the run is over
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
