// Traces have every block once, in the order of the graph, on the thread that ran it. Tracing does
// not change the sea.
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <map>
#include <mutex>
#include <sstream>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "pelagic/jobs/chrome_trace.hpp"
#include "pelagic/sim/ocean.hpp"
#include "pelagic/tests/each_executor.hpp"

namespace pelagic {
namespace {

struct Recorded {
    std::string name;
    TraceSpan span;  ///< its name may no longer exist
    std::thread::id thread;
    bool in_flight;
};

class RecordingSink final : public TraceSink {
   public:
    void work(const TraceSpan& span) noexcept override { add(span, false); }
    void in_flight(const TraceSpan& span) noexcept override { add(span, true); }

    /// Returns the spans whose first argument counts runs called `run_name`.
    std::vector<Recorded> of_runs(const std::string& run_name, bool in_flight) const {
        std::vector<Recorded> found;
        for (const Recorded& recorded : all_)
            if (recorded.span.args[0].name == run_name && recorded.in_flight == in_flight) found.push_back(recorded);
        return found;
    }
    const std::vector<Recorded>& all() const { return all_; }

   private:
    void add(const TraceSpan& span, bool in_flight) {
        const std::lock_guard lock(mutex_);
        all_.push_back({std::string(span.name), span, std::this_thread::get_id(), in_flight});
    }

    std::mutex mutex_;
    std::vector<Recorded> all_;
};

/// The smallest sea whose frames use the executor.
const SeaState traced_sea{.resolution = 128, .patch_size_m = 250};
constexpr int traced_frames = 5;

/// A few frames of a small sea, each scheduled before the previous one is read, as applications do.
class TraceOnEachExecutor : public testing::TestWithParam<ExecutorKind> {
   protected:
    std::shared_ptr<Executor> executor() const { return GetParam().make(GetParam().threads); }

    void draw() {
        ocean_.schedule(0);
        for (int i = 1; i <= traced_frames; ++i) {
            hashes_.push_back(hash_of(ocean_.complete()));
            if (i < traced_frames) ocean_.schedule(i * 0.3);
        }
    }

    std::shared_ptr<RecordingSink> sink_ = std::make_shared<RecordingSink>();
    Ocean ocean_{traced_sea, {.executor = executor(), .trace = sink_}};
    std::vector<std::uint64_t> hashes_;
};
INSTANTIATE_TEST_SUITE_P(Kinds, TraceOnEachExecutor, testing::ValuesIn(executor_kinds()),
                         [](const auto& test) { return test.param.name; });

using Job = std::tuple<std::string, double, double>;  // stage, frame, block

TEST_P(TraceOnEachExecutor, HasEveryBlockOfEveryStageOnceAFrame) {
    draw();
    std::map<Job, int> expected, found;
    for (const Stage& stage : ocean_.graph().stages())
        for (int frame = 0; frame < traced_frames; ++frame)
            for (std::size_t block = 0; block < block_count(stage); ++block)
                ++expected[{stage.name, frame, static_cast<double>(block)}];
    for (const Recorded& job : sink_->of_runs("frame", false)) {
        EXPECT_STREQ(job.span.category, "job");
        EXPECT_STREQ(job.span.args[1].name, "block");
        ++found[{job.name, job.span.args[0].value, job.span.args[1].value}];
    }
    EXPECT_EQ(found, expected);
}

// Distributing so little work to threads would only slow it down.
TEST_P(TraceOnEachExecutor, FramesOf64StayOnTheCompletingThread) {
    Ocean ocean({.resolution = 64, .patch_size_m = 250}, {.executor = executor(), .trace = sink_});
    for (int i = 0; i < traced_frames; ++i) ocean.frame_at(i);
    const auto jobs = sink_->of_runs("frame", false);
    ASSERT_FALSE(jobs.empty());
    for (const Recorded& job : jobs) EXPECT_EQ(job.thread, std::this_thread::get_id()) << job.name;
}

// A graph of its own, because the sea's stages may all have batches of one item.
TEST_P(TraceOnEachExecutor, CountsBlocksAndNotItems) {
    JobGraph graph;
    graph.add({.name = "sevens", .count = 7, .batch = 3, .body = [](std::size_t, std::size_t) {}});
    const auto sink = std::make_shared<RecordingSink>();
    const auto run = prepare_traced(*executor(), graph, sink, "round");
    run->schedule();
    run->complete();
    std::vector<double> blocks;
    for (const Recorded& job : sink->of_runs("round", false)) blocks.push_back(job.span.args[1].value);
    std::sort(blocks.begin(), blocks.end());
    EXPECT_EQ(blocks, (std::vector<double>{0, 1, 2}));
}

TEST_P(TraceOnEachExecutor, StagesStartAfterTheirDependenciesHaveEnded) {
    draw();
    const std::vector<Recorded> jobs = sink_->of_runs("frame", false);
    const auto stages = ocean_.graph().stages();
    for (int frame = 0; frame < traced_frames; ++frame) {
        std::map<std::string, TraceClock::time_point> first_start, last_end;
        for (const Recorded& job : jobs) {
            if (job.span.args[0].value != frame) continue;
            EXPECT_LE(job.span.start, job.span.end);
            const auto start = first_start.emplace(job.name, job.span.start).first;
            start->second = std::min(start->second, job.span.start);
            const auto end = last_end.emplace(job.name, job.span.end).first;
            end->second = std::max(end->second, job.span.end);
        }
        for (const Stage& stage : stages)
            for (const StageId earlier : stage.waits_for)
                EXPECT_GE(first_start.at(stage.name), last_end.at(stages[earlier].name))
                    << stage.name << " after " << stages[earlier].name << " in frame " << frame;
    }
}

TEST_P(TraceOnEachExecutor, JobsOfOneThreadDoNotOverlap) {
    draw();
    std::map<std::thread::id, std::vector<TraceSpan>> threads;
    for (const Recorded& recorded : sink_->all())
        if (!recorded.in_flight) threads[recorded.thread].push_back(recorded.span);
    for (auto& [id, spans] : threads) {
        std::sort(spans.begin(), spans.end(),
                  [](const auto& a, const auto& b) { return std::pair(a.start, a.end) < std::pair(b.start, b.end); });
        for (std::size_t i = 1; i < spans.size(); ++i) EXPECT_GE(spans[i].start, spans[i - 1].end);
    }
}

// At any one moment. Over time there may be more: oneTBB assigns any free worker to an arena.
TEST_P(TraceOnEachExecutor, NoMoreThreadsThanTheLimitWorkAtOnce) {
    draw();
    std::vector<std::pair<TraceClock::time_point, int>> changes;
    for (const Recorded& recorded : sink_->all()) {
        if (recorded.in_flight) continue;
        changes.emplace_back(recorded.span.start, +1);
        changes.emplace_back(recorded.span.end, -1);
    }
    std::sort(changes.begin(), changes.end());  // Of two changes at one time the end is first.
    int working = 0, max = 0;
    for (const auto& [time, change] : changes) max = std::max(max, working += change);
    EXPECT_GE(max, 1);
    EXPECT_LE(max, GetParam().threads);
}

TEST_P(TraceOnEachExecutor, AFrameIsInFlightFromScheduleToCompleteAroundItsJobs) {
    draw();
    const std::vector<Recorded> flights = sink_->of_runs("frame", true);
    ASSERT_EQ(static_cast<int>(flights.size()), traced_frames);
    for (int frame = 0; frame < traced_frames; ++frame) {
        const TraceSpan& flight = flights[static_cast<std::size_t>(frame)].span;
        EXPECT_EQ(flight.args[0].value, frame);
        EXPECT_STREQ(flight.category, "flight");
        for (const Recorded& job : sink_->of_runs("frame", false)) {
            if (job.span.args[0].value != frame) continue;
            EXPECT_GE(job.span.start, flight.start);
            EXPECT_LE(job.span.end, flight.end);
        }
    }
}

TEST_P(TraceOnEachExecutor, ANewSeaIsTraced) {
    draw();
    ocean_.schedule_sea({.resolution = traced_sea.resolution, .patch_size_m = 250, .seed = 5});
    draw();
    ocean_.complete_sea();
    EXPECT_EQ(sink_->of_runs("sea", true).size(), 2u) << "the first one and the new one";
    std::map<double, int> jobs;
    for (const Recorded& job : sink_->of_runs("sea", false)) ++jobs[job.span.args[0].value];
    EXPECT_EQ(jobs.size(), 2u);
    EXPECT_EQ(jobs[0], jobs[1]);
}

TEST_P(TraceOnEachExecutor, TracedFramesAreBitIdentical) {
    draw();
    Ocean untraced(traced_sea, {.executor = executor()});
    for (int frame = 0; frame < traced_frames; ++frame)
        EXPECT_EQ(hashes_[static_cast<std::size_t>(frame)], hash_of(untraced.frame_at(frame * 0.3)));
}

TEST_P(TraceOnEachExecutor, OceansMayBeDestroyedInFlight) {
    for (int i = 0; i < 10; ++i) {
        Ocean ocean(traced_sea, {.executor = executor(), .trace = sink_});
        ocean.schedule_sea(traced_sea);
        ocean.schedule(1);
    }
    EXPECT_EQ(sink_->of_runs("frame", true).size(), 10u);
}

std::size_t times_in(const std::string& text, const std::string& part) {
    std::size_t times = 0;
    for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++times;
    return times;
}

TEST_P(TraceOnEachExecutor, OceansInFlightTogetherMayShareAChromeTrace) {
    const auto trace = std::make_shared<ChromeTrace>();
    std::size_t jobs_of_a_frame = 0;
    {
        Ocean first(traced_sea, {.executor = executor(), .trace = trace});
        Ocean second(traced_sea, {.executor = executor(), .trace = trace});
        for (const Stage& stage : first.graph().stages()) jobs_of_a_frame += block_count(stage);
        for (int frame = 0; frame < traced_frames; ++frame) {
            first.schedule(frame);
            second.schedule(frame);
            first.complete();
            second.complete();
        }
    }
    // The oceans and their stages' names no longer exist.
    std::ostringstream json;
    trace->write(json);
    EXPECT_EQ(times_in(json.str(), "\"cat\":\"job\",\"pid\":1"), times_in(json.str(), "\"ph\":\"X\""));
    EXPECT_EQ(times_in(json.str(), "\"args\":{\"frame\":"), 2 * traced_frames * jobs_of_a_frame + 4 * traced_frames);
    EXPECT_EQ(times_in(json.str(), "\"ph\":\"b\",\"name\":\"frame\""), 2u * traced_frames);
    EXPECT_EQ(trace->omitted(), 0u);
}

/// Returns a trace of spans that start at whole milliseconds from now and take a quarter of a
/// millisecond.
std::string written(std::size_t max_spans, const std::vector<TraceSpan>& spans) {
    ChromeTrace trace(max_spans);
    for (const TraceSpan& span : spans) trace.work(span);
    EXPECT_EQ(trace.omitted(), spans.size() - std::min(spans.size(), max_spans));
    std::ostringstream json;
    trace.write(json);
    return json.str();
}

TEST(ChromeTrace, WritesTheNumbersOfASpan) {
    const auto start = TraceClock::now();
    const std::string json = written(
        9,
        {{"a", "job", {{{"frame", 1234567}, {"time_s", 0.125}}}, start, start + std::chrono::nanoseconds(1234567)}});
    EXPECT_NE(json.find(R"("args":{"frame":1234567,"time_s":0.125})"), std::string::npos) << json;
    EXPECT_NE(json.find(R"("dur":1234.567)"), std::string::npos) << json;
}

TEST(ChromeTrace, EscapesNames) {
    const std::string json = written(9, {{.name = "a \"b\" \\ \n", .category = "job"}});
    EXPECT_NE(json.find(R"("name":"a \"b\" \\ \u000a")"), std::string::npos) << json;
}

TEST(ChromeTrace, CountsSpansBeyondItsCapacity) {
    const TraceSpan span{.name = "a", .category = "job"};
    const std::string json = written(2, {span, span, span});
    EXPECT_EQ(times_in(json, "\"ph\":\"X\""), 2u);
    EXPECT_NE(json.find(R"("spans_omitted":1)"), std::string::npos) << json;
}

}  // namespace
}  // namespace pelagic
