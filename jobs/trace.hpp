// Who did what and when: the hook for profilers, and a run of a graph that reports through it.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string_view>

#include "pelagic/jobs/executor.hpp"

namespace pelagic {

using TraceClock = std::chrono::steady_clock;

/// A number that a viewer shows beside a span.
struct TraceArg {
    const char* name = nullptr;  ///< a literal, or none for an argument that is not there
    double value = 0;
};

/// A piece of work or of waiting, and when it was.
struct TraceSpan {
    std::string_view name;  ///< for jobs, the stage's
    const char* category;   ///< a literal; "job", "flight" and what the application adds
    std::array<TraceArg, 2> args = {};
    TraceClock::time_point start = {}, end = {};
};

/// Takes spans as they end. Called from several threads at once, also in the middle of a frame: be quick.
class TraceSink {
   public:
    virtual ~TraceSink() = default;

    /// The calling thread did this. Spans of one thread follow or enclose each other.
    virtual void work(const TraceSpan& span) noexcept = 0;

    /// This was under way, whoever worked on it; it may overlap with anything.
    virtual void in_flight(const TraceSpan& span) noexcept = 0;
};

/// What the calling thread does from here to the end of the scope, as one span. Without a sink nothing, and no clock
/// is read.
class TraceScope {
   public:
    /// \param sink  may be none; it and the name outlive the scope
    TraceScope(TraceSink* sink, std::string_view name, const char* category, std::array<TraceArg, 2> args = {})
        : sink_(sink), span_{name, category, args} {
        if (sink_) span_.start = TraceClock::now();
    }
    ~TraceScope() {
        if (!sink_) return;
        span_.end = TraceClock::now();
        sink_->work(span_);
    }
    TraceScope(const TraceScope&) = delete;
    TraceScope& operator=(const TraceScope&) = delete;

   private:
    TraceSink* sink_;
    TraceSpan span_;
};

/// executor.prepare(graph), with a span for each block of each stage (named as the stage, category "job", the run's
/// number and the block's as arguments) and one in flight from schedule() to the end of complete() (category
/// "flight"). Works with any executor: it gets the same stages, edges and blocks, with bodies that tell the time.
/// \param run_name  a literal: what one run of this graph makes, for instance "frame"; names the span in flight and
///                  the argument that counts the runs from 0
/// \param runs      how many there were: given to several graphs, one of which runs at a time, it counts those of all
std::unique_ptr<GraphRun> prepare_traced(Executor& executor, const JobGraph& graph, std::shared_ptr<TraceSink> sink,
                                         const char* run_name,
                                         std::shared_ptr<std::uint64_t> runs = std::make_shared<std::uint64_t>());

}  // namespace pelagic
