// Foam accumulation and decay in frames of one cascade:
//
//   foam_n = max(source(J_n), foam_(n-1) - F), in bytes, F = 17
//
// A texel is an undisplaced position, so orbital motion needs no advection. Drift moves foam by
// whole texels at ticks. After 255 / F = 15 ticks a full byte has decayed to 0, so older ticks have
// no effect.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/foam/drift.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

class FoamHistory {
   public:
    /// \pre the slots have one cascade
    FoamHistory(FrameSlots& slots, const Kernels& kernels, const Allocator& memory);
    FoamHistory(const FoamHistory&) = delete;  // its stage points to it
    FoamHistory& operator=(const FoamHistory&) = delete;

    /// Adds the stage of one tick and returns it. \param surface_done  the stage that computes the
    /// tick's displacement
    StageId add_tick_stage(JobGraph& graph, StageId surface_done);
    /// Clears all foam.
    void forget();
    /// Moves to the next tick, which the next run of the stage computes. \pre no run is in flight
    /// \param at_tick  grid and whitecap threshold of the tick
    /// \param drift    of the foam since the last tick
    void advance(const Cascade& at_tick, const DriftTexels& drift);

    std::size_t bytes() const;

    /// Returns N^2 bytes of foam, as of the last tick.
    const std::uint8_t* remembered() const { return maps_[newest_].data(); }

   private:
    static constexpr int ticks_to_empty = 255 / FoamTickJob::fade + 1;
    void tick_rows(std::size_t job);

    FrameSlots& slots_;
    const Kernels& kernels_;
    std::array<AlignedBuffer<std::uint8_t>, 2> maps_;
    std::size_t newest_ = 0;
    CascadeGrid grid_;
    FoamSource source_;
    std::size_t shift_x_ = 0, shift_z_ = 0;
    int ticks_to_fade_ = 0;  ///< ticks until both maps are 0, if no more water breaks
};

}  // namespace pelagic
