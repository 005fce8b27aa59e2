// Foam accumulation and decay, for each cascade:
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
#include <span>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

class FoamHistory {
   public:
    FoamHistory(FrameSlots& slots, const Kernels& kernels, const Allocator& memory);
    FoamHistory(const FoamHistory&) = delete;  // stages point into it
    FoamHistory& operator=(const FoamHistory&) = delete;

    /// Adds the stages of one tick. Returns the stages after which the tick is stored, by cascade.
    /// \param surfaces_done  the stages that compute the tick's displacement, by cascade
    std::vector<StageId> add_tick_stages(JobGraph& graph, std::span<const StageId> surfaces_done);
    /// Clears all foam.
    void forget();
    /// Moves to the next tick, which the next run of the stages computes. \pre no run is in flight
    void advance();

    std::size_t bytes() const;

    /// Returns the cascade's description at the next tick: its grid and whitecap threshold.
    Cascade& cascade(std::size_t cascade) { return cascades_[cascade].at_tick; }
    /// Sets the drift of the cascade's foam in the next tick, in texels of either sign along its
    /// axes.
    /// \pre cascade() has the whitecap threshold of the tick
    void set_drift(std::size_t cascade, int texels_x, int texels_z);

    /// Returns N^2 bytes of foam, as of the last tick.
    const std::uint8_t* remembered(std::size_t cascade) const { return cascades_[cascade].maps[newest_].data(); }

   private:
    static constexpr int ticks_to_empty = 255 / FoamTickJob::fade + 1;
    void tick_rows(std::size_t cascade, std::size_t job);

    struct CascadeMemory {
        Cascade at_tick;
        std::size_t shift_x = 0, shift_z = 0;
        int ticks_to_fade = 0;  ///< ticks until both maps are 0, if no more water breaks
        std::array<AlignedBuffer<std::uint8_t>, 2> maps;
    };
    FrameSlots& slots_;
    const Kernels& kernels_;
    std::vector<CascadeMemory> cascades_;
    std::size_t newest_ = 0;
};

}  // namespace pelagic
