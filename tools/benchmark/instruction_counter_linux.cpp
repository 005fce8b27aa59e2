#include "pelagic/tools/benchmark/instruction_counter.hpp"

#include <linux/perf_event.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace pelagic::tools {
namespace {

int open_event() {
    perf_event_attr event{};
    event.size = sizeof event;
    event.type = PERF_TYPE_HARDWARE;
    event.config = PERF_COUNT_HW_INSTRUCTIONS;
    event.read_format = PERF_FORMAT_TOTAL_TIME_ENABLED | PERF_FORMAT_TOTAL_TIME_RUNNING;
    event.exclude_kernel = 1;
    event.exclude_hv = 1;
    constexpr int this_thread = 0, any_cpu = -1, no_group = -1;
    return static_cast<int>(
        ::syscall(SYS_perf_event_open, &event, this_thread, any_cpu, no_group, PERF_FLAG_FD_CLOEXEC));
}

std::string reason_text(int error) {
    switch (error) {
        case EACCES:
        case EPERM: return "/proc/sys/kernel/perf_event_paranoid forbids it";
        case ENOENT:
        case EOPNOTSUPP:
        case ENODEV: return "this machine has no counter; most virtual machines have none";
        default: return std::string("perf_event_open: ") + std::strerror(error);
    }
}

}  // namespace

InstructionCounter::InstructionCounter() : event_(open_event()) {
    if (!event_.is_open()) message_ = reason_text(errno);
}

std::optional<std::uint64_t> InstructionCounter::count() const {
    struct {
        std::uint64_t instructions, ns_enabled, ns_running;
    } counted;
    if (!event_.is_open() || ::read(event_.get(), &counted, sizeof counted) != sizeof counted) return {};
    if (counted.ns_running == 0 || counted.ns_running < counted.ns_enabled) return {};
    return counted.instructions;
}

}  // namespace pelagic::tools
