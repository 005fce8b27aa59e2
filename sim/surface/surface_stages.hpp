// Stages `gradients+mipmaps`, `mipmaps tail`, `slopes+mipmaps` and `slopes tail`: they compute the
// textures of a cascade from its displacement. Stage `columns+textures` replaces the first of each
// map in frames without planes.
#pragma once

#include <cstddef>
#include <optional>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/surface/mipmaps.hpp"
#include "pelagic/sim/surface/slope_maps.hpp"
#include "pelagic/sim/surface/texture_bands.hpp"

namespace pelagic {

/// The texture stages of a cascade.
class SurfaceStages {
   public:
    SurfaceStages(FrameSlots& slots, std::size_t cascade, const Kernels& kernels);
    SurfaceStages(const SurfaceStages&) = delete;  // stages hold pointers to the object
    SurfaceStages& operator=(const SurfaceStages&) = delete;

    /// Adds the stages to a graph. \param surface_done  the stage that writes the cascade's
    /// displacement
    void add_to(JobGraph& graph, StageId surface_done);
    /// As above for a cascade without planes, whose bands transform columns, too.
    /// \param lines_done  the stage that computes the cascade's lines
    void add_bands_to(JobGraph& graph, StageId lines_done, TransformColumns transform);

    std::size_t bytes() const {
        return (gradient_averages_ ? gradient_averages_->bytes() : 0) +
               (slope_averages_ ? slope_averages_->bytes() : 0);
    }

   private:
    void add_tails(JobGraph& graph, StageId gradients_done, StageId slopes_done);
    PresentCompression present_compression();
    GradientsJob gradients_job();
    void gradients_mipmaps(std::size_t piece);
    void strip_textures(const TextureStrip& strip);
    void mipmaps_tail();
    /// \param surface  null for the tail
    SlopeMaps slope_maps(const float* surface = nullptr);
    /// Returns whether the slope stages write the half floats. Else the gradient stages do.
    bool slopes_make_halves() const { return slope_averages_.has_value(); }

    FrameSlots& slots_;
    std::size_t cascade_;
    const Kernels& kernels_;
    int resolution_;
    std::optional<MipAverages> gradient_averages_, slope_averages_;
};

}  // namespace pelagic
