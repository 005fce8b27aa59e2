// Baking of spectra: computes the waves of an ocean's seas at t = 0 with the stages `spectrum`.
#pragma once

#include <cstddef>
#include <memory>

#include "pelagic/jobs/executor.hpp"
#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/jobs/trace.hpp"
#include "pelagic/sim/cascades/weather.hpp"

namespace pelagic {

/// Bakes the seas of a forecast ahead of the frames that need them, and the sea that replaces the
/// forecast. One sea is baked at a time. Not thread-safe. Functions throw what executors throw; that
/// sea is lost then, and another may be baked.
class SpectrumBaker {
   public:
    /// Bakes the forecast's first sea. \pre the weather and its sources outlive the object
    SpectrumBaker(Weather& weather, Weather::Sources sources, std::shared_ptr<Executor> executor,
                  const std::shared_ptr<TraceSink>& trace);

    /// Makes the seas of a frame resident, adopts a sea that was baked ahead if it is complete, and
    /// starts to bake the seas that frames near this time will need. \pre no frame is in flight
    void begin_frame(double time_s);
    /// Makes the seas of a moment resident for a pass, and bakes a missing one immediately.
    void ensure_resident(Pass pass, double time_s);

    /// Completes the sea in flight, so that another can be baked.
    void finish();
    /// Appends a change to the forecast and starts to bake its sea. \pre finish()
    void add(const SeaChange& change);

    /// Starts to bake a sea that replaces the forecast. \pre has_other() is false
    void begin_other(const SeaState& sea);
    bool has_other() const { return baking_ == Baking::other || baking_ == Baking::staged; }
    /// Returns whether complete_other() would return without waiting for other threads.
    bool is_other_done() const;
    /// Replaces the forecast. \pre has_other(), and no frame is in flight
    void complete_other();

   private:
    enum class Baking {
        nothing,
        ahead,  ///< a sea of the forecast, for later frames
        other,  ///< the sea of begin_other(), until complete_other()
        staged  ///< that sea is complete and stored, and the run is free
    };

    void begin(std::size_t number);
    void begin_ahead(std::size_t number);
    void schedule();
    void complete();
    void drop();
    void stage();
    void bake_blocks(std::size_t max);
    bool is_baked_ahead() const;

    Weather& weather_;
    Weather::Sources sources_;
    std::shared_ptr<Executor> executor_;
    JobGraph graph_;
    Baking baking_ = Baking::nothing;
    std::size_t stage_ = 0, block_ = 0;  ///< next block of bake_blocks()
    std::unique_ptr<GraphRun> run_;      ///< last: it waits for work in flight
};

}  // namespace pelagic
