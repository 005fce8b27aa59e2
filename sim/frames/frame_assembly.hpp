// How a frame is put together: what the sources of all cascades share, the surfaces that follow from what they make, what is
// remembered between frames, and the slots that all of it goes into. When that happens, and on which executor, is the ocean's.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/buffers/frame_slots.hpp"
#include "pelagic/sim/cascades/sea_source.hpp"
#include "pelagic/sim/cascades/wave_inputs.hpp"
#include "pelagic/sim/cascades/weather.hpp"
#include "pelagic/sim/foam/history.hpp"
#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/sim/forecast.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/surface/fold_stages.hpp"
#include "pelagic/sim/surface/surface_stages.hpp"
#include "pelagic/sim/texture_targets.hpp"

namespace pelagic {

class FrameAssembly {
   public:
    /// \pre check(forecast) is empty
    FrameAssembly(const Forecast& forecast, Isa isa, const FrameExtras& wanted, WaveInputs::List inputs = {});

    /// \param after  those of its tick, by cascade, or none
    void add_frame_stages(JobGraph& graph, std::span<const StageId> after = {});
    std::vector<StageId> add_tick_stages(JobGraph& graph);
    void add_spectrum_stages(JobGraph& graph);

    /// Makes room for the next frame, before anything of it can fail; drop_frame() gives it back. \pre no frame is in flight
    void turn() { slots_.turn(); }
    /// \pre turn() for this frame, and the moment's seas are at hand
    void begin_frame(double time_s, std::span<const TextureTargets> targets);
    /// How many ticks are still to be remembered before the frame is computed.
    int ticks_due() const { return ticks_due_; }
    /// When the first of them is.
    double next_tick_s() const;
    /// The next run of the tick's stages is that one. \pre its moment's seas are at hand
    void begin_tick();
    /// What the frame shows of dynamic waves; before end_frame().
    void show(const DynamicWavesView& dynamic_waves) { slots_.frame().dynamic_waves = dynamic_waves; }
    void show(const ShoreSurface& shore) { slots_.frame().shore = shore; }
    const Frame& end_frame();
    void drop_frame();

    /// Whatever was being remembered may be half of it.
    void forget() { newest_tick_.reset(); }
    /// What the next change, or the one that is forgotten for it, says of the past may be another past than the foam's.
    void keep_foam_of(const SeaChange& next);
    std::vector<std::uint8_t> saved_history() const;
    void restore_history(std::span<const std::uint8_t> saved);

    void begin_sea(std::size_t number);
    void adopt_sea();
    void begin_other_weather(const SeaState& sea);
    void adopt_other_weather();
    void stage_sea();
    void drop_sea();

    Weather& weather() { return weather_; }
    const Weather& weather() const { return weather_; }
    FrameContents contents() const { return {extras_.velocities, extras_.gradients, extras_.slopes, extras_.foam}; }
    std::size_t cascade_count() const { return slots_.cascade_count(); }
    int resolution() const { return slots_.resolution(); }
    std::size_t texels() const;
    std::size_t bytes() const;  ///< without the object itself

   private:
    void begin_inputs(Pass pass, double time_s, double time_in_loop_s);
    Cascade& cascade_of(Pass pass, std::size_t cascade) {
        return pass == Pass::frame ? slots_.cascade(cascade) : foam_->cascade(cascade);
    }
    std::unique_ptr<SeaSource> source_of(WaveModel waves, std::size_t cascade);
    TickClock clock() const;
    SeaMoment moment_at_tick(std::int64_t number) const;
    void plan_ticks(double time_s);
    void show_foam();

    Isa isa_;
    Weather weather_;
    FrameExtras extras_;
    FrameSlots slots_;
    std::vector<std::unique_ptr<SeaSource>> sources_;
    std::vector<std::unique_ptr<SurfaceStages>> surfaces_;
    FoldStages folds_;
    WaveInputs inputs_;
    std::optional<FoamHistory> foam_;
    TickPlace frame_tick_;                     ///< of the frame begun last
    std::optional<std::int64_t> newest_tick_;  ///< none: nothing is remembered
    int ticks_due_ = 0;
    bool foam_ends_with_frame_ = false;  ///< the frame in flight is the last one that what it remembers is right for
};

}  // namespace pelagic
