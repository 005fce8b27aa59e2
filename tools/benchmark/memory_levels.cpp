#include "pelagic/tools/benchmark/memory_levels.hpp"

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstring>
#include <nlohmann/json.hpp>

#include "pelagic/message/number_text.hpp"
#include "pelagic/tools/benchmark/machine.hpp"
#include "pelagic/tools/files/input_file.hpp"
#include "pelagic/tools/text/errors.hpp"
#include "pelagic/tools/text/path_text.hpp"

namespace pelagic::tools {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::size_t bytes_per_kib = 1024, bytes_per_mib = 1024 * bytes_per_kib;

/// Larger caches are shared by many cores, and a copy in this size is no faster or slower.
constexpr std::size_t max_bytes_in_cache = 32 * bytes_per_mib;
constexpr std::size_t max_bytes_in_memory = 512 * bytes_per_mib;

/// Parts of a copy. The C library copies larger parts with stores that bypass the cache, which
/// frames do not use.
constexpr std::size_t copy_part_bytes = bytes_per_kib;

/// Returns the maximum speed of copies between the halves of a buffer.
double copy_gb_per_s(std::size_t bytes) {
    std::vector<char> buffer(bytes, 1);
    const std::size_t half = bytes / 2 / copy_part_bytes * copy_part_bytes;
    const std::size_t copies = std::max<std::size_t>(1, bytes_per_mib / half);
    double best = 0;
    const Clock::time_point begin = Clock::now();
    do {
        const Clock::time_point start = Clock::now();
        for (std::size_t i = 0; i < copies; ++i)
            for (std::size_t at = 0; at < half; at += copy_part_bytes) {
                std::memcpy(buffer.data() + half + at, buffer.data() + at, copy_part_bytes);
                __asm__ volatile("" : : "r"(buffer.data()) : "memory");
            }
        const double ns = std::chrono::duration<double, std::nano>(Clock::now() - start).count();
        best = std::max(best, 3 * static_cast<double>(half * copies) / ns);
    } while (Clock::now() - begin < std::chrono::milliseconds(100));
    return best;
}

std::string size_text(std::size_t bytes) {
    if (bytes == 0) return "-";
    return bytes < bytes_per_mib ? number_text(bytes / bytes_per_kib) + " KiB"
                                 : number_text(bytes / bytes_per_mib) + " MiB";
}

/// Returns the level that takes longest; null if the sea has not been counted.
const MovedBytes* slowest_of(const std::vector<MovedBytes>& moved) {
    const auto found = std::max_element(moved.begin(), moved.end(),
                                        [](const MovedBytes& a, const MovedBytes& b) { return a.ms < b.ms; });
    return found == moved.end() ? nullptr : &*found;
}

}  // namespace

std::vector<MemoryLevel> measure_memory_levels() {
    std::vector<MemoryLevel> levels;
    std::size_t before = 0;
    for (const std::size_t bytes : cache_sizes()) {
        const std::size_t used = std::max(std::min(bytes / 2, max_bytes_in_cache), std::min(bytes, 2 * before));
        levels.push_back({"L" + number_text(levels.size() + 1), bytes, copy_gb_per_s(used)});
        before = bytes;
    }
    if (before > 0 && 2 * before <= max_bytes_in_memory)
        levels.push_back({"memory", 0, copy_gb_per_s(std::min(8 * before, max_bytes_in_memory))});
    return levels;
}

std::vector<CountedBytes> read_counted_bytes(const std::string& option, const std::string& file) {
    constexpr const char* accepted = "a file of counts as bench/bytes.json";
    constexpr std::size_t max_bytes = bytes_per_mib;
    const std::string text = InputFile(option, path_of(file), accepted).read_all(max_bytes);
    std::vector<CountedBytes> counts;
    try {
        const auto json = nlohmann::json::parse(text);
        for (const auto& row : json.at("bytes_per_texel"))
            counts.push_back({row.at("sea"), row.at("cache_bytes"),
                              row.at("read").get<double>() + row.at("for_writing").get<double>() +
                                  row.at("written").get<double>()});
    } catch (const nlohmann::json::exception&) {
        throw bad_value(option, file, accepted);
    }
    return counts;
}

std::vector<MovedBytes> moved_bytes(const FrameTiming& frame, const std::vector<MemoryLevel>& levels,
                                    const std::vector<CountedBytes>& counts) {
    std::vector<MovedBytes> moved;
    const double texels = static_cast<double>(frame.cascades) * frame.resolution * frame.resolution;
    for (std::size_t i = 1; i < levels.size(); ++i) {
        const CountedBytes* counted = nullptr;
        for (const CountedBytes& one : counts)
            if (one.sea == frame.sea() && one.cache_bytes <= levels[i - 1].bytes &&
                (!counted || one.cache_bytes >= counted->cache_bytes))
                counted = &one;
        if (!counted) return {};
        const double bytes = counted->bytes_per_texel * texels, ms = bytes / (levels[i].copy_gb_per_s * 1e6);
        moved.push_back({&levels[i], bytes, ms, ms / frame.ms.median});
    }
    return moved;
}

void print_moved_bytes(const Timings& timings, const std::vector<MemoryLevel>& levels,
                       const std::vector<CountedBytes>& counts) {
    std::printf("%s, %s, pelagic " PELAGIC_VERSION "\n\n%-8s%10s%12s\n", cpu_name().c_str(), compiler_name().c_str(),
                "level", "size", "copy, GB/s");
    for (const MemoryLevel& level : levels)
        std::printf("%-8s%10s%12.1f\n", level.name.c_str(), size_text(level.bytes).c_str(), level.copy_gb_per_s);
    std::printf("\nFrames on one thread, %s: MB from each level, and ms at its copy speed\n%-8s%9s",
                std::string(name_of(timings.frames.front().isa)).c_str(), "sea", "ms");
    for (std::size_t i = 1; i < levels.size(); ++i) std::printf(" |%8s MB%8s", levels[i].name.c_str(), "ms");
    std::printf(" | longest\n");
    for (const FrameTiming& frame : timings.frames) {
        std::printf("%-8s%9.4f", frame.sea().c_str(), frame.ms.median);
        const std::vector<MovedBytes> moved = moved_bytes(frame, levels, counts);
        for (const MovedBytes& of_level : moved) std::printf(" |%11.3f%8.4f", of_level.bytes / 1e6, of_level.ms);
        if (const MovedBytes* slowest = slowest_of(moved))
            std::printf(" | %s, %.0f %%\n", slowest->level->name.c_str(), 100 * slowest->share);
        else
            std::printf(" | not counted for this sea\n");
    }
    std::printf(
        "copy: bytes read, fetched for writing and written; MB: counted with AVX2 by valgrind, for caches\n"
        "of these sizes; longest: the level whose ms are longest, as a fraction of the frame. Near 100 %%\n"
        "the level bounds the frame; far below, instructions do.\n");
}

}  // namespace pelagic::tools
