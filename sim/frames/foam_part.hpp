// Foam of breaking waves as a part of a frame. A frame depends on the last 16 ticks before its time.
#pragma once

#include <optional>

#include "pelagic/sim/buffers/frame_part.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/cascades/weather.hpp"
#include "pelagic/sim/foam/snapshots.hpp"
#include "pelagic/sim/frames/kept_ticks.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

class FoamPart final : public FramePart {
   public:
    /// \param repeats  whether the waves of a constant sea repeat with its loop: not with wave inputs
    FoamPart(FrameSlots& slots, const Weather& weather, const Kernels& kernels, bool repeats);

    void add_stages(JobGraph& graph, Pass pass, std::span<StageId> surfaces_done) override;
    void begin(const PassMoment& at) override;
    void end(Frame&) override { ticks_.end(); }
    void drop() override { ticks_.drop(); }
    const TicksDue* ticks() const override { return &ticks_.due(); }
    void forget() override { ticks_.forget(); }
    void before_change(const SeaChange& next) override { ticks_.before_change(next); }
    std::size_t bytes() const override;

   private:
    void begin_tick(const PassMoment& at);
    void set_drift(const PassMoment& at);
    void set_views();

    FrameSlots& slots_;
    const Weather& weather_;
    KeptTicks ticks_;
    FoamSnapshots snapshots_;
    std::optional<std::size_t> drift_sea_;  ///< sea with whose drift snapshots are stored
};

}  // namespace pelagic
