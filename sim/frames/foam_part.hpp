// Foam of breaking waves as a part of a frame. It asks for ticks (foam/tick_clock.hpp): a frame
// depends on the last 16 ticks before its time, of which only those are computed that are not kept.
#pragma once

#include <cstdint>
#include <optional>

#include "pelagic/sim/buffers/frame_part.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/cascades/weather.hpp"
#include "pelagic/sim/foam/snapshots.hpp"
#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

class FoamPart final : public FramePart {
   public:
    /// \param repeats  whether the waves of a constant sea repeat with its loop: not with wave inputs
    FoamPart(FrameSlots& slots, const Weather& weather, const Kernels& kernels, bool repeats);

    void add_stages(JobGraph& graph, Pass pass, std::span<StageId> surfaces_done) override;
    void begin(const PassMoment& at) override;
    void end(Frame& frame) override;
    void drop() override;
    const TicksDue* ticks() const override { return &due_; }
    void forget() override { newest_tick_.reset(); }
    /// Discards the ticks if the next change, or the change that is discarded for it, alters the sea
    /// at their times.
    void before_change(const SeaChange& next) override;
    std::size_t bytes() const override;

   private:
    TickClock clock() const { return TickClock(weather_.forecast().first.loop_period_s); }
    void begin_frame(const PassMoment& at);
    void begin_tick(const PassMoment& at);
    void set_drift(const PassMoment& at);
    void set_due(int count);
    void set_views();

    FrameSlots& slots_;
    const Weather& weather_;
    bool repeats_;
    FoamSnapshots snapshots_;
    std::optional<std::size_t> drift_sea_;     ///< sea with whose drift snapshots are stored
    TickTime frame_tick_;                      ///< of the frame that was begun last
    std::optional<std::int64_t> newest_tick_;  ///< none: no tick is kept
    TicksDue due_;
    /// The ticks become invalid after the frame in flight.
    bool ends_with_frame_ = false;
};

}  // namespace pelagic
