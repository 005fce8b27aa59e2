// Assembly of a frame: the sources of all cascades, the surface stages that use their output, the
// parts, and the slots that receive the results. The ocean decides when and on which executor the
// stages run.
#pragma once

#include <memory>
#include <span>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/buffers/frame_part.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/cascades/sea_source.hpp"
#include "pelagic/sim/cascades/weather.hpp"
#include "pelagic/sim/forecast.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/surface/surface_stages.hpp"
#include "pelagic/sim/texture_targets.hpp"

namespace pelagic {

class FrameAssembly {
   public:
    /// \pre check(forecast) is empty
    FrameAssembly(const Forecast& forecast, Isa isa, const FrameContents& contents, const Allocator& memory);

    /// Adds a part, before the stages.
    void add(std::unique_ptr<FramePart> part);
    std::span<const std::unique_ptr<FramePart>> parts() const { return parts_; }

    /// Adds the stages of a frame.
    /// \param after  the last stages of the frame's tick, by cascade, or none
    void add_frame_stages(JobGraph& graph, std::span<const StageId> after = {});
    /// Adds the stages of a tick. Returns those after which a frame may overwrite its surfaces, by
    /// cascade.
    std::vector<StageId> add_tick_stages(JobGraph& graph);

    /// Swaps all buffers for the next frame, before any step that may fail; drop_frame() reverts it.
    /// \pre no frame is in flight
    void swap_buffers();
    /// Prepares a frame. \pre swap_buffers() for this frame, and the moment's seas are resident
    void begin_frame(double time_s, const WaterFrame& water, std::span<const TextureTargets> targets);
    /// Returns whether frames may need ticks.
    bool has_ticks() const { return !ticks_.empty(); }
    /// Returns the ticks of which the first is to be computed next, before the frame; null if none is due.
    const TicksDue* next_tick() const;
    /// Returns whether a further tick is due after that.
    bool has_tick_after_next() const;
    /// Prepares the next tick for a run of the tick stages. \pre its moment's seas are resident
    void begin_tick();
    /// Returns whether end_frame() would return without waiting for other threads.
    bool is_done() const;
    const Frame& end_frame();
    void drop_frame();

    Weather& weather() { return weather_; }
    const Weather& weather() const { return weather_; }
    Weather::Sources sources() const { return sources_; }
    FrameSlots& slots() { return slots_; }
    const FrameContents& contents() const { return slots_.contents(); }
    std::size_t cascade_count() const { return slots_.cascade_count(); }
    int resolution() const { return slots_.resolution(); }
    std::size_t texels() const;
    std::size_t bytes() const;  ///< without the object itself

   private:
    std::unique_ptr<SeaSource> source_of(WaveModel waves, std::size_t cascade);
    StageId add_source(JobGraph& graph, Pass pass, std::size_t cascade, const std::vector<StageId>& waits_for);
    void add_parts(JobGraph& graph, Pass pass, std::span<StageId> surfaces_done);
    bool has_bands(std::size_t cascade) const;
    void begin(Pass pass, double time_s, const SeaMoment& moment, const SeaStatistics& statistics,
               std::span<Cascade> cascades);
    float compression_scale(std::size_t cascade, const SeaStatistics& statistics) const;

    Isa isa_;
    Weather weather_;
    FrameSlots slots_;
    std::vector<std::unique_ptr<SeaSource>> sources_;
    std::vector<std::unique_ptr<SurfaceStages>> surfaces_;
    std::vector<std::unique_ptr<FramePart>> parts_;
    std::vector<const TicksDue*> ticks_;  ///< of the parts that have ticks
    std::vector<Cascade> at_tick_;        ///< what sources set for a tick
};

}  // namespace pelagic
