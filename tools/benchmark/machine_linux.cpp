// Linux, which provides the names in files, and the sizes of caches by sysconf() or in files.
#include "pelagic/tools/benchmark/machine.hpp"

#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <ctime>
#include <fstream>
#include <string_view>
#include <thread>

namespace pelagic::tools {

namespace {

/// Returns the first value of a field in /proc/cpuinfo; empty if there is none.
std::string cpu_info(std::string_view field) {
    std::ifstream info("/proc/cpuinfo");
    for (std::string line; std::getline(info, line);)
        if (const auto colon = line.find(':');
            colon != std::string::npos &&
            std::string_view(line).substr(0, line.find_last_not_of(" \t", colon - 1) + 1) == field)
            return line.substr(std::min(colon + 2, line.size()));
    return {};
}

}  // namespace

std::string cpu_name() {
    if (const std::string name = cpu_info("model name"); !name.empty()) {
        // Some virtual machines use one name for all processors of a vendor, "AMD EPYC".
        if (std::any_of(name.begin(), name.end(), [](unsigned char c) { return std::isdigit(c) != 0; })) return name;
        return name + " (family " + cpu_info("cpu family") + ", model " + cpu_info("model") + ")";
    }
    std::string board;
    std::getline(std::ifstream("/sys/firmware/devicetree/base/model"), board, '\0');
    return board.empty() ? "unknown" : board;
}

std::vector<std::size_t> cache_sizes() {
    std::vector<std::size_t> sizes;
#if defined(_SC_LEVEL1_DCACHE_SIZE)
    for (const int name : {_SC_LEVEL1_DCACHE_SIZE, _SC_LEVEL2_CACHE_SIZE, _SC_LEVEL3_CACHE_SIZE})
        if (const long bytes = ::sysconf(name); bytes > 0) sizes.push_back(static_cast<std::size_t>(bytes));
#endif
    if (!sizes.empty()) return sizes;
    for (int index = 0;; ++index) {  // as on Arm
        const std::string folder = "/sys/devices/system/cpu/cpu0/cache/index" + std::to_string(index) + "/";
        std::string type;
        std::size_t kib = 0;
        if (!(std::ifstream(folder + "type") >> type) || !(std::ifstream(folder + "size") >> kib)) return sizes;
        if (type != "Instruction") sizes.push_back(kib * 1024);
    }
}

double thread_seconds() {
    timespec now{};
    ::clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

void sleep_until(std::chrono::steady_clock::time_point time) { std::this_thread::sleep_until(time); }

}  // namespace pelagic::tools
