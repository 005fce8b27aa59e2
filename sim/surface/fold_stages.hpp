// Stages `folds` and `folds tail` of each cascade: they compute the maps of possible
// self-intersections, which queries read.
#pragma once

#include <cstddef>
#include <span>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

/// The fold stages of a frame. A single cascade has a fold map. Several cascades have a contraction
/// map each. Their second stages wait for the first stages of all cascades, because the search
/// radius in one cascade depends on the displacement of the others.
class FoldStages {
   public:
    FoldStages(FrameSlots& slots, const Kernels& kernels) : slots_(slots), kernels_(kernels) {}
    FoldStages(const FoldStages&) = delete;  // stages hold pointers to the object
    FoldStages& operator=(const FoldStages&) = delete;

    /// Adds the stages to a graph. \param surfaces_done  the stages that write the cascades'
    /// displacement, one per cascade
    void add_to(JobGraph& graph, std::span<const StageId> surfaces_done);

   private:
    void spread(std::size_t cascade);

    FrameSlots& slots_;
    const Kernels& kernels_;
};

}  // namespace pelagic
