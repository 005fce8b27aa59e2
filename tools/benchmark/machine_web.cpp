// A worker of a page, whose browser hides the processor.
#include <emscripten.h>

#include "pelagic/tools/benchmark/machine.hpp"

// clang-format off
// Only isolated pages have shared memory, by which a worker can wait without spinning.
EM_JS(void, pelagic_wait_ms, (double ms), {
    if (typeof SharedArrayBuffer !== 'undefined') {
        Atomics.wait(new Int32Array(new SharedArrayBuffer(4)), 0, 0, ms);
        return;
    }
    const until = performance.now() + ms;
    while (performance.now() < until);
});
// clang-format on

namespace pelagic::tools {

std::string cpu_name() { return "unknown"; }

std::vector<std::size_t> cache_sizes() { return {}; }

double thread_seconds() { return emscripten_get_now() / 1000; }

void sleep_until(std::chrono::steady_clock::time_point time) {
    const std::chrono::duration<double, std::milli> left = time - std::chrono::steady_clock::now();
    if (left.count() > 0) pelagic_wait_ms(left.count());
}

}  // namespace pelagic::tools
