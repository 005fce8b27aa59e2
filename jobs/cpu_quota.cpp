#include "pelagic/jobs/cpu_quota.hpp"

#include <algorithm>
#include <charconv>
#include <cstdio>
#include <string_view>

namespace pelagic {
namespace {

/// Returns the beginning of a file, or an empty text if it cannot be read.
std::string text_of(const std::string& path) {
    std::string text(4096, '\0');
    std::FILE* const file = std::fopen(path.c_str(), "r");
    text.resize(file ? std::fread(text.data(), 1, text.size(), file) : 0);
    if (file) std::fclose(file);
    return text;
}

/// Returns the number at the beginning of a text, 0 without one.
long long number_of(std::string_view text) {
    long long number = 0;
    std::from_chars(text.data(), text.data() + text.size(), number);
    return number;
}

/// Returns the CPUs of one group, 0 without a limit. Version 1 has a file for each number, and -1
/// for no limit; version 2 has both numbers in one file, and "max".
int cpus_of_group(const std::string& folder, bool is_version_2) {
    const std::string first = text_of(folder + (is_version_2 ? "/cpu.max" : "/cpu.cfs_quota_us"));
    const std::string second = is_version_2 ? first.substr(std::min(first.find(' '), first.size() - 1) + 1)
                                            : text_of(folder + "/cpu.cfs_period_us");
    const long long quota_us = number_of(first), period_us = number_of(second);
    if (quota_us <= 0 || period_us <= 0) return 0;
    constexpr long long most = 1 << 20;
    return static_cast<int>(std::min(most, quota_us / period_us + (quota_us % period_us != 0)));
}

}  // namespace

int cpus_of_quota(const std::string& root) {
    int cpus = 0;
    const std::string groups = text_of(root + "/proc/self/cgroup");
    for (std::size_t begin = 0, end = 0; begin < groups.size(); begin = end + 1) {
        end = std::min(groups.find('\n', begin), groups.size());
        // number:controllers:path; version 2 has no controllers
        const std::string line = groups.substr(begin, end - begin);
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
