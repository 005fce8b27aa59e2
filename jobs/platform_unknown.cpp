// Fallback for WebAssembly and for systems without an implementation.
#include <algorithm>
#include <thread>

#include "pelagic/jobs/platform.hpp"

namespace pelagic {

Stack stack_of_this_thread() { return {}; }

std::size_t min_stack_bytes() { return 16 << 10; }

int usable_cpus() { return std::max(1, static_cast<int>(std::thread::hardware_concurrency())); }

bool has_cpu_masks() { return false; }
std::uint64_t cpus_of_this_process() { return ~std::uint64_t{0}; }
void keep_this_thread_on_cpus(std::uint64_t) {}

int current_cpu() { return -1; }
void leave_cpu(int, bool) {}

void wait_while(const std::atomic<std::uint32_t>& word, std::uint32_t value) { word.wait(value); }
void wake_all(std::atomic<std::uint32_t>& word) { word.notify_all(); }
void wake_one(std::atomic<std::uint32_t>& word) { word.notify_one(); }

}  // namespace pelagic
