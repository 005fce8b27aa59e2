#include "pelagic/tools/benchmark/bench_table.hpp"

#include <algorithm>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "pelagic/message/number_text.hpp"
#include "pelagic/tools/benchmark/machine.hpp"

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

std::string instructions_text(std::optional<double> counted) { return counted ? one_decimal(*counted) : "-"; }

/// Prints a sea's jobs and its frame, with a column for each instruction set.
void print_sea(const std::vector<const FrameTiming*>& frames) {
    const std::vector<JobTiming>& jobs = frames.front()->jobs;
    std::vector<std::string> lines;
    for (const JobTiming& job : jobs)
        lines.push_back(left_aligned(lines.empty() ? frames.front()->sea() : "", 7) + left_aligned(job.job, 18));
    lines.push_back(left_aligned("", 7) + left_aligned("frame", 18));
    for (const FrameTiming* frame : frames) {
        for (std::size_t i = 0; i < jobs.size(); ++i) {
            const JobTiming& job = frame->jobs[i];
            lines[i] +=
                cells(three_digits(job.ms.median), instructions_text(job.instructions), one_decimal(job.gb_per_s));
        }
        lines.back() += cells(three_digits(frame->ms.median), instructions_text(frame->instructions),
                              one_decimal(frame->gb_per_s));
    }
    for (const std::string& line : lines) print_line(line);
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
    for (const std::string& sea : seas) print_sea(on_one_thread(timings, sea));
    print_line("sea: cascades x N, several are the default sea; instr.: per texel; GB/s: inputs and outputs once");
    if (!timings.no_counter.empty()) print_line("Instructions are not counted: " + timings.no_counter + ".");
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

/// Refresh rates of standalone headsets' displays.
constexpr int display_hz[] = {72, 90, 120};

/// Returns the percentage of a display's frame.
double percent_of_frame(double ms, int hz) { return 100 * ms * hz / 1000; }

void print_headset_row(const FrameTiming& frame) {
    std::printf("%-6s%8d%9.3f%9.3f to %-7.3f|", frame.sea().c_str(), frame.threads, frame.ms.median, frame.ms.low,
                frame.ms.high);
    for (const int hz : display_hz) std::printf("%7.2f %%", percent_of_frame(frame.ms.median, hz));
    std::printf(" |%7.2f%9.3f\n", static_cast<double>(frame.memory_bytes) / 1e6,
                static_cast<double>(frame.upload_bytes) / 1e6);
}

}  // namespace

void print_timings(const Timings& timings) {
    print_line(cpu_name() + ", " + compiler_name() + ", pelagic " PELAGIC_VERSION);
    print_spread(timings);
    print_jobs(timings);
    print_threads(timings);
}

void print_headset_timings(const Timings& timings) {
    std::printf("%s, %s, %s, pelagic " PELAGIC_VERSION "\n\n", cpu_name().c_str(), compiler_name().c_str(),
                std::string(name_of(timings.frames.front().isa)).c_str());
    std::printf("%-6s%8s%9s%20s|", "", "", "ms", "ms,");
    for (const int hz : display_hz) std::printf("%6d Hz", hz);
    std::printf(" |%7s%9s\n", "memory", "uploaded");
    std::printf("%-6s%8s%9s%20s|", "sea", "threads", "median", "quartiles");
    for (const int hz : display_hz) std::printf("%6.1f ms", 1000.0 / hz);
    std::printf(" |%7s%9s\n", "MB", "MB");
    for (const FrameTiming& frame : timings.frames) print_headset_row(frame);
    std::printf(
        "\nsea: cascades x N; Hz: percentage of a display's frame; uploaded: textures of each frame, all levels\n");
    std::printf("docs/integrations/vr.md lists modelled times of a headset's cores.\n");
}

void print_option_costs(const std::string& sea, Isa isa, const std::vector<OptionCost>& costs) {
    std::printf("%s, %s, %s, pelagic " PELAGIC_VERSION "\n\n", cpu_name().c_str(), compiler_name().c_str(),
                std::string(name_of(isa)).c_str());
    std::printf("Processor time of a frame of %s on one thread: ms, and ratio to a bare frame\n", sea.c_str());
    std::printf("%-20s|%9s%8s |%9s%8s |%8s\n", "", "warm", "", "72 Hz", "", "memory");
    std::printf("%-20s|%9s%8s |%9s%8s |%8s\n", "option", "ms", "ratio", "ms", "ratio", "MB");
    for (const OptionCost& cost : costs)
        std::printf("%-20s|%9.3f%8.2f |%9.3f%8.2f |%8.2f\n", cost.name.c_str(), cost.warm_ms.median,
                    cost.warm_ms.median / costs.front().warm_ms.median, cost.rhythm_ms.median,
                    cost.rhythm_ms.median / costs.front().rhythm_ms.median,
                    static_cast<double>(cost.memory_bytes) / 1e6);
    std::printf("\nwarm: frames one after another; 72 Hz: a frame each %.1f ms, and sleep in between\n",
                headset_period_ms);
    std::printf("hull, 1,000 heights: a step of a dinghy and a query alone, in oceans with what they need\n");
    std::printf("boat: velocities water, depth, foam, dynamic waves 256, a dinghy with its wake, 1,000 heights\n");
}

}  // namespace pelagic::tools
