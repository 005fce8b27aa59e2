// From a tile's displacement to what consumers take: stages `gradients+mipmaps` and `mipmaps tail`, and for queries `folds`
// and `folds tail`.
#pragma once

#include <cstddef>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/surface/frame_slots.hpp"
#include "pelagic/sim/surface/mipmaps.hpp"

namespace pelagic {

/// The stages of one tile.
class SurfaceStages {
   public:
    SurfaceStages(FrameSlots& slots, std::size_t tile, const Kernels& kernels, const HostMemory& memory);
    SurfaceStages(const SurfaceStages&) = delete;  // stages point into it
    SurfaceStages& operator=(const SurfaceStages&) = delete;

    /// \param surface_done  the stage that leaves the displacement in the tile's buffers
    void add_to(JobGraph& graph, StageId surface_done);

    std::size_t bytes() const { return mip_averages_.bytes(); }

   private:
    void add_fold_stages(JobGraph& graph, StageId surface_done);
    void gradients_mipmaps(std::size_t texel_tile);
    void mipmaps_tail();

    FrameSlots& slots_;
    std::size_t tile_;
    const Kernels& kernels_;
    int resolution_;
    MipAverages mip_averages_;
};

}  // namespace pelagic
