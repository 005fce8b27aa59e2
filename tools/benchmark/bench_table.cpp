#include "pelagic/tools/benchmark/bench_table.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "pelagic/message/number_text.hpp"
#include "pelagic/tools/benchmark/machine.hpp"
#include "pelagic/tools/benchmark/stored_results.hpp"

namespace pelagic::tools {
namespace {

/// Returns three significant digits without exponent: "0.00412", "0.149", "17.3".
std::string three_digits(double value) {
    int decimals = 5;
    for (double bound = 0.01; decimals > 0 && value >= bound; bound *= 10) --decimals;
    char text[40];
    std::snprintf(text, sizeof text, "%.*f", decimals, value);
    return text;
}

std::string one_decimal(double value) {
    char text[40];
    std::snprintf(text, sizeof text, "%.1f", value);
    return text;
}

/// Returns the seas in the order of the timings: "4x128", "1x64", ...
std::vector<std::string> seas_of(const Timings& timings) {
    std::vector<std::string> seas;
    for (const FrameTiming& frame : timings.frames)
        if (seas.empty() || seas.back() != frame.sea()) seas.push_back(frame.sea());
    return seas;
}

std::vector<const FrameTiming*> on_one_thread(const Timings& timings, const std::string& sea) {
    std::vector<const FrameTiming*> frames;
    for (const FrameTiming& frame : timings.frames)
        if (frame.threads == 1 && frame.sea() == sea) frames.push_back(&frame);
    return frames;
}

void print_line(std::string line) {
    line.erase(line.find_last_not_of(' ') + 1);
    std::printf("%s\n", line.c_str());
}

/// left_aligned() and right_aligned() pad a text with blanks to `width` characters. Longer texts
/// are not truncated.
std::string left_aligned(const std::string& text, std::size_t width) {
    return text + std::string(width - std::min(width, text.size()), ' ');
}
std::string right_aligned(const std::string& text, std::size_t width) {
    return std::string(width - std::min(width, text.size()), ' ') + text;
}

std::string cells(const std::string& ms, const std::string& instructions, const std::string& gb_per_s) {
    return "|" + right_aligned(ms, 8) + right_aligned(instructions, 8) + right_aligned(gb_per_s, 7);
}

/// Returns the instructions counted on this machine, or stored ones with an asterisk.
std::string instructions_text(const FrameTiming& frame, const std::string& job, std::optional<double> counted) {
    if (counted) return one_decimal(*counted);
    const std::optional<double> stored = stored_instructions(frame.sea(), job, frame.isa);
    return stored ? one_decimal(*stored) + "*" : "-";
}

/// Prints a sea's jobs and its frame, with a column for each instruction set. Returns true if it
/// printed stored instructions.
bool print_sea(const std::vector<const FrameTiming*>& frames) {
    const std::vector<JobTiming>& jobs = frames.front()->jobs;
    std::vector<std::string> lines;
    for (const JobTiming& job : jobs)
        lines.push_back(left_aligned(lines.empty() ? frames.front()->sea() : "", 7) + left_aligned(job.job, 18));
    lines.push_back(left_aligned("", 7) + left_aligned("frame", 18));
    for (const FrameTiming* frame : frames) {
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            const JobTiming& job = frame->jobs[i];
            lines[i] += cells(three_digits(job.ms.median), instructions_text(*frame, job.job, job.instructions),
                              one_decimal(job.gb_per_s));
        }
        lines.back() +=
            cells(three_digits(frame->ms.median), instructions_text(*frame, frame->frame_job(), frame->instructions),
                  one_decimal(frame->gb_per_s));
    }
    bool has_stored = false;
    for (const std::string& line : lines) {
        print_line(line);
        has_stored |= line.find('*') != std::string::npos;
    }
    return has_stored;
}

void print_jobs(const Timings& timings) {
    const std::vector<std::string> seas = seas_of(timings);
    std::string title = left_aligned("On one thread", 25), heading = left_aligned("sea", 7) + left_aligned("job", 18);
    for (const FrameTiming* frame : on_one_thread(timings, seas.front())) {
        title += "| " + left_aligned(std::string(name_of(frame->isa)), 22);
        heading += cells("ms", "instr.", "GB/s");
    }
    print_line("");
    print_line(title);
    print_line(heading);
    bool has_stored = false;
    for (const std::string& sea : seas) has_stored |= print_sea(on_one_thread(timings, sea));
    print_line("sea: cascades x N, several are the default sea; instr.: per texel; GB/s: inputs and outputs once");
    if (!timings.no_counter.empty()) print_line("Instructions are not counted: " + timings.no_counter + ".");
    if (has_stored)
        print_line("* Stored count, by valgrind or qemu with a build by " + stored_instructions_compiler() + ".");
}

void print_threads(const Timings& timings) {
    const FrameTiming& last = timings.frames.back();
    if (last.threads == 1) return;
    const std::vector<std::string> seas = seas_of(timings);
    const auto ms_on = [&](const std::string& sea, int threads) {
        for (const FrameTiming& frame : timings.frames)
            if (frame.sea() == sea && frame.isa == last.isa && frame.threads == threads) return frame.ms.median;
        return 0.0;
    };
    print_line("");
    print_line("Frames on several threads, " + std::string(name_of(last.isa)) + ": ms, and speedup over one thread");
    std::string heading = "threads";
    for (const std::string& sea : seas) heading += "|" + right_aligned(sea, 14);
    print_line(heading);
    for (const int threads : thread_counts(last.threads)) {
        std::string line = right_aligned(number_text(threads), 7);
        for (const std::string& sea : seas) {
            char speedup[40];
            std::snprintf(speedup, sizeof speedup, "%.2f", ms_on(sea, 1) / ms_on(sea, threads));
            line += "|" + right_aligned(three_digits(ms_on(sea, threads)), 8) + right_aligned(speedup, 6);
        }
        print_line(line);
    }
}

void print_machine(const std::string& machine, const std::string& isa, const std::map<int, double>& ms,
                   const std::set<int>& sizes) {
    std::string line = left_aligned(machine.substr(0, 39), 40) + left_aligned(isa, 8);
    for (const int n : sizes) line += right_aligned(ms.contains(n) ? three_digits(ms.at(n)) : "-", 9);
    print_line(line);
}

void print_machines(const Timings& timings) {
    std::set<int> sizes;
    std::map<Isa, MachineFrames> here;
    for (const FrameTiming& frame : timings.frames) {
        if (frame.cascades != 1 || frame.threads != 1) continue;
        sizes.insert(frame.resolution);
        here[frame.isa].ms[frame.resolution] = frame.ms.median;
    }
    print_line("");
    std::string heading = left_aligned("Comparison of machines: ms per frame, N =", 48);
    for (const int n : sizes) heading += right_aligned(number_text(n), 9);
    print_line(heading);
    for (const auto& [isa, frames] : here) print_machine("this machine", std::string(name_of(isa)), frames.ms, sizes);
    for (const MachineFrames& stored : stored_frames()) {
        print_machine(stored.machine, stored.isa, stored.ms, sizes);
        if (!stored.fftw_ms.empty()) print_machine("  equal frame with FFTW", "", stored.fftw_ms, sizes);
    }
}

/// Returns the larger distance of a quartile to the median, divided by the median.
double spread_of(const Quartiles& ms) { return std::max(ms.high - ms.median, ms.median - ms.low) / ms.median; }

void print_spread(const Timings& timings) {
    constexpr double spread_of_a_busy_machine = 0.1;
    std::vector<double> spreads;
    for (const FrameTiming& frame : timings.frames) spreads.push_back(spread_of(frame.ms));
    std::sort(spreads.begin(), spreads.end());
    const double typical = spreads[spreads.size() / 2];
    std::printf("Medians of turns; quartiles within %.0f %% of the median, at most %.0f %%%s\n", 100 * typical,
                100 * spreads.back(), typical > spread_of_a_busy_machine ? ": the machine may be busy" : "");
}

}  // namespace

void print_timings(const Timings& timings) {
    print_line(cpu_name() + ", " + compiler_name() + ", pelagic " PELAGIC_VERSION);
    print_spread(timings);
    print_jobs(timings);
    print_threads(timings);
    print_machines(timings);
}

}  // namespace pelagic::tools
