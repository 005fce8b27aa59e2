#include "pelagic/jobs/cpu_quota.hpp"

#include <algorithm>
#include <fstream>

namespace pelagic {
namespace {

/// Returns the CPUs of one group, 0 without a limit. Version 1 has a file for each number, and -1
/// for no limit; version 2 has both numbers in one file, and "max".
int cpus_of_group(const std::string& folder, bool is_version_2) {
    long long quota_us = 0, period_us = 0;
    if (is_version_2) {
        std::ifstream(folder + "/cpu.max") >> quota_us >> period_us;
    } else {
        std::ifstream(folder + "/cpu.cfs_quota_us") >> quota_us;
        std::ifstream(folder + "/cpu.cfs_period_us") >> period_us;
    }
    if (quota_us <= 0 || period_us <= 0) return 0;
    constexpr long long most = 1 << 20;
    return static_cast<int>(std::min(most, quota_us / period_us + (quota_us % period_us != 0)));
}

}  // namespace

int cpus_of_quota(const std::string& root) {
    int cpus = 0;
    std::ifstream groups(root + "/proc/self/cgroup");
    // number:controllers:path; version 2 has no controllers
    for (std::string line; std::getline(groups, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (first == std::string::npos || second == std::string::npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1);
        const bool is_version_2 = controllers.empty();
        if (!is_version_2 && ("," + controllers + ",").find(",cpu,") == std::string::npos) continue;
        const std::string top = root + "/sys/fs/cgroup" + (is_version_2 ? "" : "/cpu");
        // In a container the path may be one of the host, and the limit at the top.
        for (std::string path = line.substr(second + 1);; path.erase(path.rfind('/'))) {
            if (const int here = cpus_of_group(top + path, is_version_2))
                cpus = cpus == 0 ? here : std::min(cpus, here);
            if (path.find('/') == std::string::npos) break;
        }
    }
    return cpus;
}

}  // namespace pelagic
