// What queries need to know about where the surface may lie over itself: stages `folds` and `folds tail` of each cascade.
#pragma once

#include <cstddef>
#include <span>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

/// The stages of a frame. One cascade has a fold map. Several have a contraction map each, whose second stages wait for the first ones
/// of all: how far one cascade must look depends on how far the others move the water.
class FoldStages {
   public:
    FoldStages(FrameSlots& slots, const Kernels& kernels) : slots_(slots), kernels_(kernels) {}
    FoldStages(const FoldStages&) = delete;  // stages point into it
    FoldStages& operator=(const FoldStages&) = delete;

    /// \param surfaces_done  the stages that leave the displacement in the cascades' buffers
    void add_to(JobGraph& graph, std::span<const StageId> surfaces_done);

   private:
    void spread(std::size_t cascade);

    FrameSlots& slots_;
    const Kernels& kernels_;
};

}  // namespace pelagic
