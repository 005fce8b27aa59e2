// Benchmark of frames on two threads, frame after frame and at a display's rate, when workers sleep
// between frames.
//
//   build/release/bin/pelagic_threads_bench [EVERY_MS [TURNS [ISA]]]
//
// EVERY_MS 0 computes frames one after the other. Otherwise the process sleeps for EVERY_MS before
// each frame. A time is that of frame_at(), or in a row "ahead" that of schedule() and complete()
// without the 2 ms of sleep between them, which an application draws in. Executors take turns,
// because other load on the machine varies; a speed-up is the median over the turns. Context
// switches and processor time are those of the whole process per frame, so the row of one thread
// includes the sleep between frames.
//
// The row "apart" has two oceans on two threads that share no work, and its time is half of theirs.
// Its speed-up is that of the machine: it is low if the two processors are hardware threads of one
// core, or if two frames exceed the caches.
#include <sys/resource.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdio>
#include <cstdlib>
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

constexpr int threads = 2;
constexpr double turn_ms = 4;                     // frame after frame
constexpr double ahead_ms = 2;                    // from schedule() to complete()
constexpr int warm_frames = 4, paced_frames = 8;  // each slot twice; at a display's rate

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

/// An ocean on an executor, and its measurements.
class Contestant {
   public:
    Contestant(const SeaState& sea, Isa isa, std::shared_ptr<Executor> executor, double every_ms,
               std::string name = {}, Start frames_start = Start::in_frame_at)
        : name_(name.empty() ? std::string(executor->name()) : std::move(name)),
          frames_start_(frames_start),
          threads_(executor->thread_limit()),
          every_ms_(every_ms),
          ocean_(sea, {.executor = std::move(executor), .isa = isa}) {
        for (int i = 0; i < warm_frames; ++i) ocean_.frame_at(i);
        const Clock::time_point start = Clock::now();
        ocean_.frame_at(warm_frames);
        if (every_ms_ == 0)
            frames_a_turn_ = std::max(1, static_cast<int>(turn_ms / Milliseconds(Clock::now() - start).count()));
    }

    void take_turn() {
        for (int i = 0; i < warm_frames; ++i) time_frame();
        const Usage before = usage();
        std::vector<double> frames_ms;
        for (int i = 0; i < frames_a_turn_; ++i) frames_ms.push_back(time_frame());
        count(before, frames_a_turn_);
        turns_ms_.push_back(median(frames_ms));
    }

    /// Takes a turn together with another contestant, on another thread.
    void take_turn_beside(Contestant& other) {
        std::atomic<int> ready = 0;
        const auto warm_up = [&ready](Contestant& contestant) {
            for (int i = 0; i < warm_frames; ++i) contestant.time_frame();
            ++ready;
            while (ready < 2) {
            }
        };
        std::thread beside([&] {
            warm_up(other);
            for (int i = 0; i < frames_a_turn_; ++i) other.time_frame();
        });
        warm_up(*this);
        const Usage before = usage();
        const Clock::time_point start = Clock::now();
        for (int i = 0; i < frames_a_turn_; ++i) time_frame();
        beside.join();
        const double frames = 2 * frames_a_turn_;
        turns_ms_.push_back(Milliseconds(Clock::now() - start).count() / frames);
        count(before, frames);
    }

    void print(const std::string& sea, const Contestant& one_thread) const {
        std::vector<double> speedups;
        for (std::size_t turn = 0; turn < turns_ms_.size(); ++turn)
            speedups.push_back(one_thread.turns_ms_[turn] / turns_ms_[turn]);
        std::sort(speedups.begin(), speedups.end());
        std::printf("%-6s %-7s %-7s %7d %8.1f %8.2f  %.2f to %.2f %9.1f %8.2f %11.3f\n", sea.c_str(),
                    std::string(name_of(ocean_.isa())).c_str(), name_.c_str(), threads_, 1000 * median(turns_ms_),
                    median(speedups), speedups[speedups.size() / 4], speedups[speedups.size() * 3 / 4],
                    cpu_us_ / frames_, waits_ / frames_, preemptions_ / frames_);
    }

   private:
    void count(const Usage& before, double frames) {
        const Usage after = usage();
        frames_ += frames;
        cpu_us_ += after.cpu_us - before.cpu_us;
        waits_ += after.waits - before.waits;
        preemptions_ += after.preemptions - before.preemptions;
    }

    double time_frame() {
        if (every_ms_ > 0) std::this_thread::sleep_for(Milliseconds(every_ms_));
        time_s_ += 1.0 / 72;
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
    int threads_;
    double every_ms_;
    Ocean ocean_;
    int frames_a_turn_ = paced_frames;
    double time_s_ = 0;
    std::vector<double> turns_ms_;
    double frames_ = 0, cpu_us_ = 0, waits_ = 0, preemptions_ = 0;
};

void compare(const std::string& name, const SeaState& sea, Isa isa, double every_ms, int turns) {
    std::vector<std::unique_ptr<Contestant>> contestants;
    std::vector<std::shared_ptr<Executor>> executors = {make_serial_executor(), make_thread_executor(threads)};
#if defined(PELAGIC_HAS_TBB)
    executors.push_back(make_tbb_executor(threads));
#endif
    for (const auto& executor : executors)
        contestants.push_back(std::make_unique<Contestant>(sea, isa, executor, every_ms));
    if (every_ms > 0)
        contestants.push_back(
            std::make_unique<Contestant>(sea, isa, make_default_executor(threads), every_ms, "ahead", Start::ahead));
    Contestant apart(sea, isa, make_serial_executor(), every_ms, "apart");
    Contestant beside(sea, isa, make_serial_executor(), every_ms);
    for (int turn = 0; turn < turns; ++turn) {
        for (const auto& contestant : contestants) contestant->take_turn();
        if (every_ms == 0) apart.take_turn_beside(beside);
    }
    for (const auto& contestant : contestants) contestant->print(name, *contestants.front());
    if (every_ms == 0) apart.print(name, *contestants.front());
}

int run(double every_ms, int turns, std::string_view isa_name) {
    std::printf("%-6s %-7s %-7s %7s %8s %8s  %-12s %9s %8s %11s\n", "sea", "isa", "on", "threads", "us", "speed-up",
                "quartiles", "cpu us", "waits", "preemptions");
    for (const Isa isa : isas_here()) {
        if (isa_name.empty() ? isa < Isa::avx2 : name_of(isa) != isa_name) continue;
        compare("4x128", {}, isa, every_ms, turns);
        compare("1x128", {.resolution = 128, .patch_size_m = 250}, isa, every_ms, turns);
        compare("1x256", {.resolution = 256, .patch_size_m = 250}, isa, every_ms, turns);
    }
    return 0;
}

}  // namespace
}  // namespace pelagic

int main(int argc, char** argv) {
    return pelagic::run(argc > 1 ? std::atof(argv[1]) : 0, argc > 2 ? std::max(1, std::atoi(argv[2])) : 15,
                        argc > 3 ? argv[3] : "");
}
