// Benchmark of frames on threads, frame after frame and at a display's rate, when workers sleep
// between frames.
//
//   build/release/bin/pelagic_threads_bench [EVERY_MS [TURNS [ISA [SEA [FRAMES]]]]]
//
// EVERY_MS 0 computes frames one after the other. Otherwise the process sleeps for EVERY_MS before
// each frame, and executors with four and eight threads take part. A time is that of frame_at(), or
// in a row "ahead" that of schedule() and complete() without the 2 ms of sleep between them, which
// an application draws in. Executors take turns of FRAMES frames, because other load on the machine
// varies; a speed-up is the median over the turns. "worst" is the longest of all frames over their
// median: compare it with that of one thread, which other load delays as well. Context switches and
// processor time are those of the whole process per frame, so the row of one thread includes the
// sleep between frames. ISA and SEA select one row of each, for instance avx2 and 4x128.
//
// The row "apart" has two oceans on two threads that share no work but begin together, and its time
// is half of theirs. Its speed-up is that of the machine: it is low if the two processors are
// hardware threads of one core, or if two frames exceed the caches. The line "core to core" is the
// least time in which another thread returns a cache line: up to 150 ns if the two processors share
// a cache. If they do not, shared frames take longer. A virtual machine may change from one to the
// other.
//
// For the longest of 5,000 frames (13 minutes): pelagic_threads_bench 13.9 10 avx2 4x128 500
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <thread>
#include <utility>
#include <vector>

#include "pelagic/sim/ocean.hpp"

namespace pelagic {
namespace {

using Clock = std::chrono::steady_clock;
using Milliseconds = std::chrono::duration<double, std::milli>;

enum class Start { in_frame_at, ahead };

constexpr double turn_ms = 4;                     // frame after frame
constexpr double ahead_ms = 2;                    // from schedule() to complete()
constexpr int warm_frames = 4;                    // each slot twice
constexpr int paced_frames = 8;                   // of a turn, at a display's rate

double median(std::vector<double> values) {
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    return *middle;
}

/// Resources that the process has used so far.
struct Usage {
    double cpu_us, waits, preemptions;
};

Usage usage() {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    const auto us = [](const timeval& time) {
        return 1e6 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_usec);
    };
    return {us(used.ru_utime) + us(used.ru_stime), static_cast<double>(used.ru_nvcsw),
            static_cast<double>(used.ru_nivcsw)};
}

struct Pace {
    double every_ms;  ///< 0: frame after frame
    int turns, frames_a_turn = paced_frames;
};

/// An ocean on an executor, and its measurements.
class Contestant {
   public:
    Contestant(const SeaState& sea, Isa isa, std::shared_ptr<Executor> executor, const Pace& pace,
               int threads = 1, std::string name = {}, Start frames_start = Start::in_frame_at)
        : name_(name.empty() ? std::string(executor->name()) : std::move(name)),
          frames_start_(frames_start),
          threads_(threads),
          every_ms_(pace.every_ms),
          frames_a_turn_(pace.frames_a_turn),
          ocean_(sea, {.executor = std::move(executor), .isa = isa}) {
        for (int i = 0; i < warm_frames; ++i) ocean_.frame_at(i);
        const Clock::time_point start = Clock::now();
        ocean_.frame_at(warm_frames);
        if (every_ms_ == 0)
            frames_a_turn_ = std::max(1, static_cast<int>(turn_ms / Milliseconds(Clock::now() - start).count()));
    }

    void take_turn() {
        take_turn([] {}, 1);
    }

    /// Takes a turn together with another contestant on another thread, which begins each frame when
    /// this one does. A time is half of that of a frame.
    void take_turn_beside(Contestant& other) {
        other.frames_a_turn_ = frames_a_turn_;
        std::atomic<int> arrivals = 0;
        const auto meet = [&arrivals] {
            for (const int both = (arrivals++ / 2 + 1) * 2; arrivals < both;) {
            }
        };
        std::thread beside([&] { other.take_turn(meet, 2); });
        take_turn(meet, 2);
        beside.join();
    }

    void print(const std::string& sea, const Contestant& one_thread) const {
        std::vector<double> speedups;
        for (std::size_t turn = 0; turn < turns_ms_.size(); ++turn)
            speedups.push_back(one_thread.turns_ms_[turn] / turns_ms_[turn]);
        std::sort(speedups.begin(), speedups.end());
        std::printf("%-6s %-7s %-7s %7d %8.1f %6.1f %8.2f  %.2f to %.2f %9.1f %8.2f %11.3f\n", sea.c_str(),
                    std::string(name_of(ocean_.isa())).c_str(), name_.c_str(), threads_, 1000 * median(turns_ms_),
                    worst_ms_ / median(turns_ms_), median(speedups), speedups[speedups.size() / 4],
                    speedups[speedups.size() * 3 / 4], cpu_us_ / frames_, waits_ / frames_, preemptions_ / frames_);
    }

   private:
    /// \param start   called before each frame
    /// \param oceans  that take the turn together
    void take_turn(const std::function<void()>& start, int oceans) {
        for (int i = 0; i < warm_frames; ++i) time_frame(start);
        const Usage before = usage();
        std::vector<double> frames_ms;
        for (int i = 0; i < frames_a_turn_; ++i) frames_ms.push_back(time_frame(start) / oceans);
        count(before, frames_a_turn_ * oceans);
        worst_ms_ = std::max(worst_ms_, *std::max_element(frames_ms.begin(), frames_ms.end()));
        turns_ms_.push_back(median(std::move(frames_ms)));
    }

    void count(const Usage& before, double frames) {
        const Usage after = usage();
        frames_ += frames;
        cpu_us_ += after.cpu_us - before.cpu_us;
        waits_ += after.waits - before.waits;
        preemptions_ += after.preemptions - before.preemptions;
    }

    double time_frame(const std::function<void()>& start_together) {
        if (every_ms_ > 0) std::this_thread::sleep_for(Milliseconds(every_ms_));
        time_s_ += 1.0 / 72;
        start_together();
        const Clock::time_point start = Clock::now();
        if (frames_start_ == Start::in_frame_at) {
            ocean_.frame_at(time_s_);
            return Milliseconds(Clock::now() - start).count();
        }
        ocean_.schedule(time_s_);
        const Clock::time_point scheduled = Clock::now();
        std::this_thread::sleep_for(Milliseconds(ahead_ms));
        const Clock::time_point drawn = Clock::now();
        ocean_.complete();
        return Milliseconds(Clock::now() - drawn + (scheduled - start)).count();
    }

    std::string name_;
    Start frames_start_;
    int threads_;  ///< as requested
    double every_ms_;
    int frames_a_turn_;
    Ocean ocean_;
    double time_s_ = 0, worst_ms_ = 0;
    std::vector<double> turns_ms_;
    double frames_ = 0, cpu_us_ = 0, waits_ = 0, preemptions_ = 0;
};

/// Returns the least mean time of some hundred exchanges between this thread and another one.
double core_to_core_ns() {
    constexpr int exchanges = 200, turns = 100;
    std::atomic<int> value = 0;
    const auto wait_for = [&value](int wanted) {
        while (value.load(std::memory_order_acquire) != wanted) {
        }
    };
    std::thread other([&] {
        for (int i = 1; i <= exchanges * turns; ++i) {
            wait_for(2 * i - 1);
            value.store(2 * i, std::memory_order_release);
        }
    });
    double least_ms = 1e9;
    for (int turn = 0, i = 1; turn < turns; ++turn) {
        const Clock::time_point start = Clock::now();
        for (const int end = i + exchanges; i < end; ++i) {
            value.store(2 * i - 1, std::memory_order_release);
            wait_for(2 * i);
        }
        least_ms = std::min(least_ms, Milliseconds(Clock::now() - start).count());
    }
    other.join();
    return 1e6 * least_ms / exchanges;
}

void compare(const std::string& name, const SeaState& sea, Isa isa, const Pace& pace) {
    std::vector<std::unique_ptr<Contestant>> contestants;
    const auto add = [&](const auto&... arguments) {
        contestants.push_back(std::make_unique<Contestant>(sea, isa, arguments...));
    };
    add(make_serial_executor(), pace);
    for (const int threads : {2, 4, 8}) {
        if (pace.every_ms == 0 && threads > 2) break;
        add(make_thread_executor(threads), pace, threads);
#if defined(PELAGIC_HAS_TBB)
        add(make_tbb_executor(threads), pace, threads);
#endif
    }
    if (pace.every_ms > 0) add(make_default_executor(2), pace, 2, "ahead", Start::ahead);
    Contestant apart(sea, isa, make_serial_executor(), pace, 1, "apart");
    Contestant beside(sea, isa, make_serial_executor(), pace);
    for (int turn = 0; turn < pace.turns; ++turn) {
        for (const auto& contestant : contestants) contestant->take_turn();
        apart.take_turn_beside(beside);
    }
    std::printf("%-6s %-7s core to core %.0f ns\n", name.c_str(), std::string(name_of(isa)).c_str(), core_to_core_ns());
    for (const auto& contestant : contestants) contestant->print(name, *contestants.front());
    apart.print(name, *contestants.front());
}

int run(const Pace& pace, std::string_view isa_name, std::string_view sea_name) {
    std::printf("%-6s %-7s %-7s %7s %8s %6s %8s  %-12s %9s %8s %11s\n", "sea", "isa", "on", "threads", "us", "worst",
                "speed-up", "quartiles", "cpu us", "waits", "preemptions");
    const std::pair<const char*, SeaState> seas[] = {{"4x128", {}},
                                                     {"1x64", {.resolution = 64, .patch_size_m = 250}},
                                                     {"1x128", {.resolution = 128, .patch_size_m = 250}},
                                                     {"1x256", {.resolution = 256, .patch_size_m = 250}}};
    for (const Isa isa : isas_here()) {
        if (isa_name.empty() ? isa < Isa::avx2 : name_of(isa) != isa_name) continue;
        for (const auto& [name, sea] : seas)
            if (sea_name.empty() || sea_name == name) compare(name, sea, isa, pace);
    }
    return 0;
}

}  // namespace
}  // namespace pelagic

int main(int argc, char** argv) {
    const auto number = [&](int i, int otherwise) { return argc > i ? std::max(1, std::atoi(argv[i])) : otherwise; };
    return pelagic::run({.every_ms = argc > 1 ? std::atof(argv[1]) : 0,
                         .turns = number(2, 15),
                         .frames_a_turn = number(5, pelagic::paced_frames)},
                        argc > 3 ? argv[3] : "", argc > 4 ? argv[4] : "");
}
