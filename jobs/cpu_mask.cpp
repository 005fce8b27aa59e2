#include "pelagic/jobs/cpu_mask.hpp"

#include <bit>
#include <charconv>
#include <stdexcept>
#include <string>

#include "pelagic/jobs/platform.hpp"

namespace pelagic {
namespace {

[[noreturn]] void reject(std::uint64_t cpu_mask, const char* needs) {
    char digits[16];
    const auto length =
        static_cast<std::size_t>(std::to_chars(digits, digits + sizeof digits, cpu_mask, 16).ptr - digits);
    throw std::invalid_argument("cpu_mask is 0x" + std::string(digits, length) + ", expected " + needs);
}

}  // namespace

int checked_cpus(std::uint64_t cpu_mask) {
    if (cpu_mask == 0) return 0;
    if (!has_cpu_masks()) reject(cpu_mask, "0 on this system, which has no masks");
    const std::uint64_t usable = cpu_mask & cpus_of_this_process();
    if (usable == 0) reject(cpu_mask, "a CPU that this process may use");
    return std::popcount(usable);
}

void keep_this_thread_on(std::uint64_t cpu_mask) {
    // The process may lose CPUs after the check, so an error is ignored.
    if (cpu_mask != 0) keep_this_thread_on_cpus(cpu_mask);
}

}  // namespace pelagic
