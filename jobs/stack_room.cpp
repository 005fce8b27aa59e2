#include "pelagic/jobs/stack_room.hpp"

#include <cstdint>
#include <exception>
#include <string>
#include <system_error>

#include "pelagic/jobs/job_thread.hpp"
#include "pelagic/jobs/platform.hpp"
#include "pelagic/message/number_text.hpp"

namespace pelagic {
namespace {

// The C library stores thread-local variables at the end of the stack; ThreadSanitizer's take 768
// KiB.
constexpr std::size_t thread_local_bytes = std::size_t{1} << 20;

}  // namespace

bool stack_holds(std::size_t bytes) {
    const Stack stack = stack_of_this_thread();
    if (bytes == 0 || stack.end == 0) return true;
    const auto here = reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0));
    return here >= stack.begin && here < stack.end && here - stack.begin >= bytes;
}

void run_on_a_stack_of(std::size_t bytes, const std::function<void()>& work) {
    std::exception_ptr failure;
    try {
        JobThread thread(
            [&] {
                try {
                    work();
                } catch (...) {
                    failure = std::current_exception();
                }
            },
            bytes + thread_local_bytes);
        thread.join();
    } catch (const std::system_error& error) {
        throw std::system_error(error.code(), "the calling thread's stack is too small for a job of " +
                                                  number_text(bytes / 1024) +
                                                  " KiB, and no thread with a larger one can be had");
    }
    if (failure) std::rethrow_exception(failure);
}

}  // namespace pelagic
