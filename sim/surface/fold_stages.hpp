// Stages `folds` and `folds tail` of each cascade: they compute the maps of possible
// self-intersections, which queries read.
#pragma once

#include <cstddef>
#include <span>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/buffers/frame_part.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

/// The fold stages of a frame. A single cascade has a fold map. Several cascades have a contraction
/// map each. Their second stages wait for the first stages of all cascades, because the search
/// radius in a cascade depends on the displacement of the others.
class FoldStages final : public FramePart {
   public:
    FoldStages(FrameSlots& slots, const Kernels& kernels) : slots_(slots), kernels_(kernels) {}

    void add_stages(JobGraph& graph, Pass pass, std::span<StageId> surfaces_done) override;
    std::size_t bytes() const override { return sizeof *this; }

   private:
    void spread(std::size_t cascade);

    FrameSlots& slots_;
    const Kernels& kernels_;
};

}  // namespace pelagic
