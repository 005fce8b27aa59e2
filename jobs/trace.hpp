// Tracing: the interface for profilers, and graph runs that report their jobs to it.
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <memory>
#include <string_view>

#include "pelagic/jobs/executor.hpp"

namespace pelagic {

using TraceClock = std::chrono::steady_clock;

/// A named number that trace viewers show with a span.
struct TraceArg {
    const char* name = nullptr;  ///< a string literal; null for an unused argument
    double value = 0;
};

/// A time interval of work or waiting.
struct TraceSpan {
    std::string_view name;  ///< for jobs, the name of the stage
    const char* category;   ///< a string literal: "job", "flight" or one of the application's
    std::array<TraceArg, 2> args = {};
    TraceClock::time_point start = {}, end = {};
};

/// Receives spans when they end. Thread safety: several threads call it at once, also while a frame
/// is computed, so implementations must be fast.
class TraceSink {
   public:
    virtual ~TraceSink() = default;

    /// Receives a span of work of the calling thread. Spans of one thread are disjoint or nested.
    virtual void work(const TraceSpan& span) noexcept = 0;

    /// Receives a span that belongs to no thread. It may overlap with any other span.
    virtual void in_flight(const TraceSpan& span) noexcept = 0;
};

/// Reports the time from construction to destruction as one span of work of the calling thread. If
/// the sink is null, nothing is reported and no clock is read.
class TraceScope {
   public:
    /// \param sink  may be null; the sink and the name must outlive the scope
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

/// Calls executor.prepare() for a copy of the graph whose bodies report spans. Each block of each
/// stage reports a span of work: its name is the stage's, its category "job", its arguments are the
/// numbers of the run and the block. Each run reports a span in flight from schedule() to the end
/// of complete(), with category "flight". Works with any executor; stages, dependencies and blocks
/// are those of `graph`.
/// \param sink      if null, nothing is reported: the result is executor.prepare(graph)
/// \param run_name  a string literal for the result of a run, for instance "frame": name of the
///                  span in flight and of the argument that counts runs from 0
/// \param runs      counter of runs. Several graphs may share it if only one of them runs at a
///                  time.
std::unique_ptr<GraphRun> prepare_traced(Executor& executor, const JobGraph& graph, std::shared_ptr<TraceSink> sink,
                                         const char* run_name,
                                         std::shared_ptr<std::uint64_t> runs = std::make_shared<std::uint64_t>());

}  // namespace pelagic
