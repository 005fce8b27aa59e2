#include "pelagic/bench/machine.hpp"

#include <fstream>

namespace pelagic::bench {

std::string cpu_name() {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
    return "unknown";
}

std::string compiler_name() {
#if defined(__clang__)
    return "clang++ " __clang_version__;
#else
    return "g++ " __VERSION__;
#endif
}

PinnedToOneCore::PinnedToOneCore() {
    sched_getaffinity(0, sizeof before_, &before_);
    cpu_set_t one;
    CPU_ZERO(&one);
    for (int core = CPU_SETSIZE - 1; core >= 0; --core) {
        if (!CPU_ISSET(core, &before_)) continue;
        CPU_SET(core, &one);
        break;
    }
    sched_setaffinity(0, sizeof one, &one);
}

PinnedToOneCore::~PinnedToOneCore() { sched_setaffinity(0, sizeof before_, &before_); }

}  // namespace pelagic::bench
