// Assembly of a frame: the sources of all cascades, the surface stages that use their output, foam
// history, and the slots that receive the results. The ocean decides when and on which executor the
// stages run.
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
#include "pelagic/sim/foam/snapshots.hpp"
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

    /// Adds the stages of a frame.
    /// \param after  the last stages of the frame's tick, by cascade, or none
    void add_frame_stages(JobGraph& graph, std::span<const StageId> after = {});
    std::vector<StageId> add_tick_stages(JobGraph& graph);
    void add_spectrum_stages(JobGraph& graph);

    /// Swaps the slots for the next frame, before any step that may fail; drop_frame() reverts it.
    /// \pre no frame is in flight
    void turn() { slots_.turn(); }
    /// Prepares a frame. \pre turn() for this frame, and the moment's seas are resident
    void begin_frame(double time_s, std::span<const TextureTargets> targets);
    /// Returns the number of foam ticks to compute before the frame.
    int ticks_due() const { return ticks_due_; }
    /// Returns the time of the first of these ticks.
    double next_tick_s() const;
    /// Prepares that tick for the next run of the tick stages. \pre its moment's seas are resident
    void begin_tick();
    /// Set the frame's water frame, dynamic waves and shore. \pre before end_frame()
    void show(const WaterFrame& water) { slots_.frame().water_frame = water; }
    void show(const DynamicWavesView& dynamic_waves) { slots_.frame().dynamic_waves = dynamic_waves; }
    void show(const ShoreSurface& shore) { slots_.frame().shore = shore; }
    const Frame& end_frame();
    void drop_frame();

    /// Discards the foam history, which may be incomplete after a failure.
    void forget() { newest_tick_.reset(); }
    /// Discards the foam history if the next change, or the change that is discarded for it, alters
    /// the sea at times of the history.
    void keep_foam_of(const SeaChange& next);

    void begin_sea(std::size_t number);
    void adopt_sea();
    void begin_other_weather(const SeaState& sea);
    void adopt_other_weather();
    void stage_sea();
    void drop_sea();

    Weather& weather() { return weather_; }
    const Weather& weather() const { return weather_; }
    FrameContents contents() const {
        return {extras_.velocities, extras_.gradients, extras_.slopes, extras_.foam, extras_.planes};
    }
    std::size_t cascade_count() const { return slots_.cascade_count(); }
    int resolution() const { return slots_.resolution(); }
    std::size_t texels() const;
    std::size_t bytes() const;  ///< without the object itself

   private:
    void begin_inputs(Pass pass, double time_s, double time_in_loop_s);
    Cascade& cascade_of(Pass pass, std::size_t cascade) {
        return pass == Pass::frame ? slots_.cascade(cascade) : at_tick_[cascade];
    }
    std::unique_ptr<SeaSource> source_of(WaveModel waves, std::size_t cascade);
    bool has_bands(std::size_t cascade) const;
    TickClock clock() const;
    SeaMoment moment_at_tick(std::int64_t number) const;
    float compression_scale(std::size_t cascade, const SeaStatistics& statistics) const;
    void set_foam_drift(const SeaMoment& moment);
    void plan_ticks(const SeaMoment& moment);
    void show_foam();

    Isa isa_;
    Weather weather_;
    FrameExtras extras_;
    FrameSlots slots_;
    std::vector<std::unique_ptr<SeaSource>> sources_;
    std::vector<std::unique_ptr<SurfaceStages>> surfaces_;
    FoldStages folds_;
    WaveInputs inputs_;
    std::vector<Cascade> at_tick_;             ///< what sources set for a tick
    std::optional<FoamHistory> history_;       ///< with foam and one cascade
    std::optional<FoamSnapshots> snapshots_;   ///< with foam
    std::optional<std::size_t> drift_sea_;     ///< sea with whose drift snapshots are stored
    TickPlace frame_tick_;                     ///< of the frame that begin_frame() began last
    std::optional<std::int64_t> newest_tick_;  ///< none: there is no foam history
    int ticks_due_ = 0;
    /// The foam history becomes invalid after the frame in flight.
    bool foam_ends_with_frame_ = false;
};

}  // namespace pelagic
