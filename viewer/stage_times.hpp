// How long each stage of the last frames took, for the panel's plots.
#pragma once

#include <array>
#include <mutex>
#include <string>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/jobs/trace.hpp"

namespace pelagic::viewer {

/// Adds up what workers report between two frames; the window's thread reads.
class StageTimes final : public TraceSink {
   public:
    static constexpr std::size_t frames_kept = 120;

    /// One stage of all cascades: milliseconds of work, all threads together, the oldest frame first.
    struct Row {
        std::string name;
        std::array<float, frames_kept> ms{};
    };

    void work(const TraceSpan& span) noexcept override;
    void in_flight(const TraceSpan&) noexcept override {}

    /// What has come since the last call is one frame.
    void end_frame();
    const std::vector<Row>& rows() const { return rows_; }
    /// Reserves a row for each stage, so that work() never allocates.
    void follow(const JobGraph& graph);

   private:
    std::mutex mutex_;
    std::vector<Row> rows_;
    std::vector<double> now_ms_;
};

}  // namespace pelagic::viewer
