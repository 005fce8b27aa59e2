// Stage `inputs`: adds wave inputs of the application (sim/wave_input.hpp) to each cascade. The
// stage runs after the cascade's source and before the stages that read the surface.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/buffers/frame_part.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/wave_input.hpp"

namespace pelagic {

class WaveInputs final : public FramePart {
   public:
    using List = std::vector<std::shared_ptr<WaveInput>>;

    /// \throws std::invalid_argument if an input is null
    WaveInputs(List inputs, FrameSlots& slots, Isa isa);

    FilledBy add_cascade_stages(JobGraph& graph, Pass pass, std::size_t cascade, FilledBy filled) override;
    /// \throws std::invalid_argument if an input's largest_slope is out of range
    void begin(const PassMoment& at) override;
    /// Sets the bounds of the cascades that have inputs.
    void end(Frame& frame) override;
    std::size_t bytes() const override;  ///< excludes the memory of the inputs

   private:
    /// Widens the cascade's slope ranges so that they hold the sum of the source's and the inputs'
    /// slopes.
    void begin_cascade(const PassMoment& at, std::size_t cascade);
    FrameBounds bounds(std::size_t cascade) const;
    std::size_t rows_per_job() const;
    std::size_t jobs() const { return static_cast<std::size_t>(slots_.resolution()) / rows_per_job(); }
    void add_rows(Pass pass, std::size_t cascade, std::size_t job);

    FrameSlots& slots_;
    const Kernels& kernels_;
    List inputs_;
    OfEachPass<InputMoment> moments_;
    OfEachPass<std::vector<CascadeGrid>> grids_;
    OfEachPass<std::vector<std::uint8_t>> adds_;  ///< by cascade; 1: an input adds to it
    std::vector<FrameBounds> bounds_;             ///< [cascade][job], of the frame
};

}  // namespace pelagic
