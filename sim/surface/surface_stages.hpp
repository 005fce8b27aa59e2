// Stages `gradients+mipmaps`, `mipmaps tail`, `slopes+mipmaps`, `slopes tail` and `foam tail`: they
// compute the textures of a cascade from its displacement.
#pragma once

#include <cstddef>
#include <optional>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/surface/mipmaps.hpp"
#include "pelagic/sim/surface/slope_maps.hpp"

namespace pelagic {

/// The texture stages of one cascade.
class SurfaceStages {
   public:
    SurfaceStages(FrameSlots& slots, std::size_t cascade, const Kernels& kernels, const FrameExtras& extras);
    SurfaceStages(const SurfaceStages&) = delete;  // stages hold pointers to the object
    SurfaceStages& operator=(const SurfaceStages&) = delete;

    /// Adds the stages to a graph. \param surface_done  the stage that writes the cascade's
    /// displacement
    void add_to(JobGraph& graph, StageId surface_done);

    std::size_t bytes() const {
        return (gradient_averages_ ? gradient_averages_->bytes() : 0) +
               (slope_averages_ ? slope_averages_->bytes() : 0);
    }

   private:
    void add_gradient_stages(JobGraph& graph, StageId surface_done);
    void add_slope_stages(JobGraph& graph, StageId surface_done);
    void add_foam_tail(JobGraph& graph, StageId foam_done);
    ShownFoam shown_foam();
    PresentCompression present_compression();
    void gradients_mipmaps(std::size_t piece);
    void mipmaps_tail();
    SlopeMaps slope_maps();
    /// Returns whether the slope stages write the half floats and the compression. With one cascade
    /// the gradient stages write the half floats, with foam. Several cascades always have slopes.
    bool slopes_make_halves() const { return slots_.cascade_count() > 1; }

    FrameSlots& slots_;
    std::size_t cascade_;
    const Kernels& kernels_;
    int resolution_;
    bool has_foam_;
    std::optional<MipAverages> gradient_averages_, slope_averages_;
};

}  // namespace pelagic
