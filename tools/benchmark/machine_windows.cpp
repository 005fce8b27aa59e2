// Windows, where the name is read with CPUID.
#include <cpuid.h>
#include <windows.h>

#include <array>
#include <cstring>
#include <thread>

#include "pelagic/tools/benchmark/machine.hpp"

namespace pelagic::tools {

std::string cpu_name() {
    // Three leaves return 48 characters in their registers, on some processors with surrounding
    // blanks.
    constexpr unsigned first_leaf = 0x80000002, last_leaf = 0x80000004;
    std::string name;
    for (unsigned leaf = first_leaf; leaf <= last_leaf; ++leaf) {
        std::array<unsigned, 4> registers{};
        if (__get_cpuid(leaf, &registers[0], &registers[1], &registers[2], &registers[3]) == 0) return "unknown";
        char letters[sizeof registers];
        std::memcpy(letters, registers.data(), sizeof letters);
        name.append(letters, sizeof letters);
    }
    name.resize(std::strlen(name.c_str()));
    const std::size_t begin = name.find_first_not_of(' '), end = name.find_last_not_of(' ');
    return begin == std::string::npos ? "unknown" : name.substr(begin, end - begin + 1);
}

std::vector<std::size_t> cache_sizes() {
    DWORD bytes = 0;
    GetLogicalProcessorInformation(nullptr, &bytes);
    std::vector<SYSTEM_LOGICAL_PROCESSOR_INFORMATION> entries(bytes / sizeof(SYSTEM_LOGICAL_PROCESSOR_INFORMATION));
    if (entries.empty() || !GetLogicalProcessorInformation(entries.data(), &bytes)) return {};
    std::vector<std::size_t> sizes;
    for (const auto& entry : entries)
        if (entry.Relationship == RelationCache && (entry.ProcessorMask & 1) != 0 &&
            entry.Cache.Type != CacheInstruction && entry.Cache.Level == sizes.size() + 1)
            sizes.push_back(entry.Cache.Size);
    return sizes;
}

double thread_seconds() {
    FILETIME created{}, ended{}, kernel{}, user{};
    GetThreadTimes(GetCurrentThread(), &created, &ended, &kernel, &user);
    const auto seconds = [](const FILETIME& time) {  // in units of 100 ns
        return 429.4967296 * time.dwHighDateTime + 1e-7 * time.dwLowDateTime;
    };
    return seconds(kernel) + seconds(user);
}

void sleep_until(std::chrono::steady_clock::time_point time) { std::this_thread::sleep_until(time); }

}  // namespace pelagic::tools
