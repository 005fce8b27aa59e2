// What applications add to the waves of the cascades (sim/wave_input.hpp): the stage `inputs` of each cascade, between its source and what follows
// from the surface. Without inputs there is no such stage.
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

    /// Throws std::invalid_argument if one is null.
    WaveInputs(List inputs, FrameSlots& slots, Isa isa, bool has_velocities);
    WaveInputs(const WaveInputs&) = delete;  // stages point into it
    WaveInputs& operator=(const WaveInputs&) = delete;

    bool empty() const { return inputs_.empty(); }

    /// Adds the stage of a cascade's pass, which adds to what its source leaves in the slot. Returns the one after which the surface
    /// stands: without inputs the source's own.
    StageId add_stage(JobGraph& graph, Pass pass, std::size_t cascade, const FilledBy& filled);

    /// What the next run of the pass's stages adds. First the grids, as the sources have begun the cascades; last what becomes of
    /// each cascade, whose slopes are as steep as both.
    void set_grid(Pass pass, std::size_t cascade, const CascadeGrid& grid) { grids_[pass][cascade] = grid; }
    void begin(Pass pass, double time_s, double time_in_loop_s, double loop_period_s);
    void begin_cascade(Pass pass, std::size_t cascade, Cascade& at);

    /// Of the last run of frames: something was added to the cascade, and these are the extremes of the sum.
    bool adds_to(std::size_t cascade) const { return adds_[Pass::frame][cascade] != 0; }
    FrameBounds bounds(std::size_t cascade) const;

    std::size_t bytes() const;  ///< without the inputs themselves

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
    OfEachPass<std::vector<std::uint8_t>> adds_;  ///< to the cascade
    std::vector<PartBounds> bounds_;              ///< of each job of each cascade's frame
};

}  // namespace pelagic
