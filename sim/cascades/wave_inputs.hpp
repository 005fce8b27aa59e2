// Stage `inputs`: adds wave inputs of the application (sim/wave_input.hpp) to each cascade. The
// stage runs after the cascade's source and before the stages that read the surface. Without
// inputs, no stage is added.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/cascades/sea_source.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/wave_input.hpp"

namespace pelagic {

class WaveInputs {
   public:
    using List = std::vector<std::shared_ptr<WaveInput>>;

    /// \throws std::invalid_argument if an input is null
    WaveInputs(List inputs, FrameSlots& slots, Isa isa, bool has_velocities);
    WaveInputs(const WaveInputs&) = delete;  // stages point into it
    WaveInputs& operator=(const WaveInputs&) = delete;

    bool empty() const { return inputs_.empty(); }

    /// Adds the stage that adds the inputs to the displacement in the slot. Returns the stage after
    /// which the surface is complete: without inputs, filled.displacement.
    StageId add_stage(JobGraph& graph, Pass pass, std::size_t cascade, const FilledBy& filled);

    /// Set up the next run of the pass's stages. Call set_grid() for each cascade, after its source
    /// has begun; then begin(); then begin_cascade() for each cascade. begin_cascade() widens the
    /// cascade's slope ranges so that they hold the sum of the source's and the inputs' slopes.
    /// \throws std::invalid_argument (begin_cascade) if an input's largest_slope is out of range
    void set_grid(Pass pass, std::size_t cascade, const CascadeGrid& grid) { grids_[pass][cascade] = grid; }
    void begin(Pass pass, double time_s, double time_in_loop_s, double loop_period_s);
    void begin_cascade(Pass pass, std::size_t cascade, Cascade& at);

    /// Returns whether the last frame's run added waves to the cascade.
    bool adds_to(std::size_t cascade) const { return adds_[Pass::frame][cascade] != 0; }
    /// Returns the extremes of the sum. \pre adds_to(cascade)
    FrameBounds bounds(std::size_t cascade) const;

    std::size_t bytes() const;  ///< excludes the memory of the inputs

   private:
    std::size_t rows_a_job() const;
    std::size_t jobs() const { return static_cast<std::size_t>(slots_.resolution()) / rows_a_job(); }
    void add_rows(Pass pass, std::size_t cascade, std::size_t job);

    FrameSlots& slots_;
    const Kernels& kernels_;
    List inputs_;
    bool has_velocities_;
    OfEachPass<InputMoment> moments_;
    OfEachPass<std::vector<CascadeGrid>> grids_;
    OfEachPass<std::vector<std::uint8_t>> adds_;  ///< by cascade; 1: an input adds to it
    std::vector<PlaneBounds> bounds_;             ///< [cascade][job], of the frame
};

}  // namespace pelagic
