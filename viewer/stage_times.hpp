// Records the time of each stage of the last frames, for the panel's plots.
#pragma once

#include <array>
#include <mutex>
#include <string>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/jobs/trace.hpp"

namespace pelagic::viewer {

/// Accumulates the times that worker threads report between two frames. work() and end_frame() may
/// run concurrently; only the window's thread calls end_frame(), rows() and follow().
class StageTimes final : public TraceSink {
   public:
    static constexpr std::size_t frames_kept = 120;

    /// One stage, summed over all cascades and threads: milliseconds of work, oldest frame first.
    struct Row {
        std::string name;
        std::array<float, frames_kept> ms{};
    };

    void work(const TraceSpan& span) noexcept override;
    void in_flight(const TraceSpan&) noexcept override {}

    /// Stores the times since the last call as one frame.
    void end_frame();
    const std::vector<Row>& rows() const { return rows_; }
    /// Creates a row for each stage of the graph, so that work() does not allocate.
    void follow(const JobGraph& graph);

   private:
    std::mutex mutex_;
    std::vector<Row> rows_;
    std::vector<double> now_ms_;
};

}  // namespace pelagic::viewer
