// What makes waves: fills the displacement of one tile of each frame.
#pragma once

#include <cstddef>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/tile.hpp"

namespace pelagic {

class WaveSource {
   public:
    virtual ~WaveSource() = default;

    /// Adds the stages of a frame, which fill the buffers of the source's tile in the slot that is the back one when they run.
    /// Returns the one after which the displacement stands. The source outlives the graph's runs.
    virtual StageId add_frame_stages(JobGraph& graph) = 0;

    /// What the next run of these stages makes: says what the tile is, too. \pre none is in flight
    virtual void begin_frame(double time_s) = 0;
    /// The extremes of the last run.
    virtual FrameBounds end_frame() = 0;

    virtual std::size_t bytes() const = 0;
};

}  // namespace pelagic
