#include "pelagic/tools/benchmark/frame_timing.hpp"

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <string_view>
#include <utility>

#include "pelagic/jobs/trace.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tools/benchmark/instruction_counter.hpp"
#include "pelagic/tools/benchmark/stage_work.hpp"

namespace pelagic::tools {
namespace {

using Clock = std::chrono::steady_clock;

/// Duration of a turn. It is long compared to a clock read (30 ns), and short compared to the time
/// slices of other programs (milliseconds), so that most turns are undisturbed even on a busy
/// machine.
constexpr double turn_ms = 1;
constexpr std::size_t min_turns = 5;

double ms_since(Clock::time_point start) {
    return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

std::unique_ptr<Ocean> ocean_of(const SeaState& sea, Isa isa, int threads, bool planes,
                                std::shared_ptr<TraceSink> trace = {}) {
    return std::make_unique<Ocean>(
        sea, OceanOptions{.executor = threads == 1 ? make_serial_executor() : make_default_executor(threads),
                          .isa = isa,
                          .trace = std::move(trace),
                          .planes = planes});
}

/// Returns the jobs of a graph in the order of their stages. A job of several cascades appears
/// once.
std::vector<std::string> jobs_of(const JobGraph& graph) {
    std::vector<std::string> jobs;
    for (const Stage& stage : graph.stages())
        if (const std::string_view job = job_of(stage.name); std::find(jobs.begin(), jobs.end(), job) == jobs.end())
            jobs.emplace_back(job);
    return jobs;
}

/// A trace sink that sums the time of each job of frames on one thread.
class JobClock final : public TraceSink {
   public:
    explicit JobClock(std::vector<std::string> jobs) : jobs_(std::move(jobs)), ms_(jobs_.size()) {}

    void work(const TraceSpan& span) noexcept override {
        for (std::size_t i = 0; i < jobs_.size(); ++i)
            if (jobs_[i] == job_of(span.name))
                ms_[i] += std::chrono::duration<double, std::milli>(span.end - span.start).count();
    }
    void in_flight(const TraceSpan&) noexcept override {}

    void reset() { std::fill(ms_.begin(), ms_.end(), 0); }
    const std::vector<std::string>& jobs() const { return jobs_; }
    const std::vector<double>& ms() const { return ms_; }

   private:
    std::vector<std::string> jobs_;
    std::vector<double> ms_;
};

std::size_t texture_bytes(const Frame& frame) {
    std::size_t bytes = 0;
    for (const Cascade& cascade : frame.cascades)
        bytes += cascade.displacement_rgba16f.size_bytes() + cascade.gradient_rgba8.size_bytes() +
                 cascade.slopes_rgba8.size_bytes() + cascade.moments_rgba8.size_bytes();
    return bytes;
}

/// An ocean whose frames are timed. On one thread, a second ocean with a trace sink times the jobs,
/// because tracing costs time.
class TimedSea {
   public:
    TimedSea(const SeaState& sea, Isa isa, int threads, bool planes)
        : ocean_(ocean_of(sea, isa, threads, planes)), threads_(threads), planes_(planes) {
        draw(*ocean_, frames_before_a_turn_);
        const Clock::time_point start = Clock::now();
        draw(*ocean_, 1);
        frames_a_turn_ = std::max(1, static_cast<int>(turn_ms / ms_since(start)));
        if (threads > 1) {
            frames_before_a_turn_ += frames_a_turn_;  // wakes sleeping workers
            return;
        }
        clock_ = std::make_shared<JobClock>(jobs_of(ocean_->graph()));
        traced_ocean_ = ocean_of(sea, isa, threads, planes, clock_);
        jobs_.resize(clock_->jobs().size());
    }

    void take_turn() {
        draw(*ocean_, frames_before_a_turn_);
        const Clock::time_point start = Clock::now();
        draw(*ocean_, frames_a_turn_);
        turns_ms_.push_back(ms_since(start) / frames_a_turn_);
        if (!traced_ocean_) return;
        draw(*traced_ocean_, frames_before_a_turn_);
        clock_->reset();
        draw(*traced_ocean_, frames_a_turn_);
        for (std::size_t i = 0; i < jobs_.size(); ++i) jobs_[i].turns_ms.push_back(clock_->ms()[i] / frames_a_turn_);
    }

    std::string sea() const { return sea_name(static_cast<int>(ocean_->cascade_count()), ocean_->resolution()); }
    std::size_t turns() const { return turns_ms_.size(); }

    /// Counts the instructions of a frame and of its jobs. Stages run again on the data of the last
    /// frame, because their work does not depend on the values.
    void count_instructions(const InstructionCounter& counter) {
        instructions_ = min_count(counter, [&] { draw(*ocean_, 1); });
        for (std::size_t i = 0; i < jobs_.size(); ++i)
            jobs_[i].instructions = min_count(counter, [&] {
                for (const Stage& stage : ocean_->graph().stages())
                    if (job_of(stage.name) == clock_->jobs()[i])
                        for (std::size_t block = 0; block < block_count(stage); ++block) run_block(stage, block);
            });
    }

    FrameTiming result() const {
        FrameTiming frame{.cascades = static_cast<int>(ocean_->cascade_count()),
                          .resolution = ocean_->resolution(),
                          .isa = ocean_->isa(),
                          .threads = threads_,
                          .planes = planes_,
                          .ms = quartiles_of(turns_ms_),
                          .gb_per_s = 0,
                          .instructions = instructions_,
                          .jobs = {},
                          .memory_bytes = ocean_->memory_bytes(),
                          .upload_bytes = texture_bytes(ocean_->complete())};
        const auto gb_per_s = [&](double bytes_per_texel, double ms) {
            return bytes_per_texel * texels() / (ms * 1e6);
        };
        const FrameShape shape{frame.cascades, frame.resolution, ocean_->complete().cascades[0].height.block_columns};
        double frame_bytes = 0;
        for (const std::string& job : jobs_of(ocean_->graph())) frame_bytes += work_of(job, shape).bytes;
        frame.gb_per_s = gb_per_s(frame_bytes, frame.ms.median);
        for (std::size_t i = 0; i < jobs_.size(); ++i) {
            const std::string& job = clock_->jobs()[i];
            const Quartiles ms = quartiles_of(jobs_[i].turns_ms);
            frame.jobs.push_back({job, ms, gb_per_s(work_of(job, shape).bytes, ms.median), jobs_[i].instructions});
        }
        return frame;
    }

   private:
    struct Job {
        std::vector<double> turns_ms;
        std::optional<double> instructions;
    };

    double texels() const {
        return static_cast<double>(ocean_->cascade_count()) * ocean_->resolution() * ocean_->resolution();
    }

    void draw(Ocean& ocean, int frames) {
        for (int i = 0; i < frames; ++i) ocean.frame_at(time_s_ += 1.0 / 72);
    }

    /// Returns the minimum count per texel of three runs, because the first run may touch memory
    /// for the first time.
    template <class Work>
    std::optional<double> min_count(const InstructionCounter& counter, const Work& work) const {
        std::optional<double> min;
        for (int i = 0; i < 3; ++i) {
            const std::optional<std::uint64_t> before = counter.count();
            work();
            const std::optional<std::uint64_t> after = counter.count();
            if (!before || !after || *after == *before) return {};
            const double count = static_cast<double>(*after - *before) / texels();
            min = std::min(min.value_or(count), count);
        }
        return min;
    }

    std::unique_ptr<Ocean> ocean_, traced_ocean_;
    std::shared_ptr<JobClock> clock_;
    int threads_, frames_a_turn_ = 1;
    bool planes_;
    /// Warm-up frames: other oceans have used the caches, and frames alternate between two slots.
    int frames_before_a_turn_ = 2;
    double time_s_ = 0;
    std::vector<double> turns_ms_;
    std::optional<double> instructions_;
    std::vector<Job> jobs_;
};

/// The configurations of one sea that are measured in turns.
struct Round {
    SeaState sea;
    std::vector<std::pair<Isa, int>> isas_and_threads;
};

/// Returns the rounds. Frames on one thread are a separate round, because a pool's workers spin for
/// a while after each frame and disturb the next measurement.
std::vector<Round> rounds_of(const TimingPlan& plan) {
    std::vector<Round> rounds;
    for (const SeaState& sea : plan.seas) {
        Round& one_thread = rounds.emplace_back(Round{sea, {}});
        for (const Isa isa : plan.isas) one_thread.isas_and_threads.emplace_back(isa, 1);
        if (plan.threads.back() == 1) continue;
        Round& more_threads = rounds.emplace_back(Round{sea, {}});
        for (const int threads : plan.threads)
            if (threads > 1) more_threads.isas_and_threads.emplace_back(plan.isas.back(), threads);
    }
    return rounds;
}

}  // namespace

Quartiles quartiles_of(std::vector<double> values) {
    std::sort(values.begin(), values.end());
    const auto at = [&](double fraction) {
        return values[static_cast<std::size_t>(fraction * static_cast<double>(values.size() - 1) + 0.5)];
    };
    return {at(0.5), at(0.25), at(0.75)};
}

std::vector<SeaState> headset_seas() {
    return {{.resolution = 128, .patch_size_m = 250},
            {.resolution = 256, .patch_size_m = 250},
            {.cascades = 3, .resolution = 64},
            {.cascades = 3, .resolution = 128},
            {.cascades = 4, .resolution = 128}};
}

std::vector<int> thread_counts(int max) {
    std::vector<int> counts;
    for (int threads = 1; threads < max; threads *= 2) counts.push_back(threads);
    counts.push_back(max);
    return counts;
}

Timings time_frames(const TimingPlan& plan, const std::function<void(const std::string&, double)>& progress) {
    const InstructionCounter counter;
    const Clock::time_point start = Clock::now();
    const auto seconds = [&] { return ms_since(start) / 1000; };
    Timings timings{.frames = {}, .no_counter = counter.unavailable_reason()};
    const std::vector<Round> rounds = rounds_of(plan);
    for (std::size_t i = 0; i < rounds.size(); ++i) {
        const double until_s = seconds() + (plan.seconds - seconds()) / static_cast<double>(rounds.size() - i);
        std::vector<TimedSea> contestants;
        for (const auto& [isa, threads] : rounds[i].isas_and_threads) {
            TimedSea& contestant = contestants.emplace_back(rounds[i].sea, isa, threads, plan.planes);
            if (threads == 1) contestant.count_instructions(counter);
        }
        while (contestants.back().turns() < min_turns || seconds() < until_s)
            for (TimedSea& contestant : contestants) {
                contestant.take_turn();
                progress(contestant.sea(), std::min(1.0, seconds() / plan.seconds));
            }
        for (const TimedSea& contestant : contestants) timings.frames.push_back(contestant.result());
    }
    const auto is_counted = [](const FrameTiming& frame) { return frame.instructions.has_value(); };
    if (timings.no_counter.empty() && std::none_of(timings.frames.begin(), timings.frames.end(), is_counted))
        timings.no_counter = "another program used the counter";
    return timings;
}

}  // namespace pelagic::tools
