// What fills the displacement of one cascade, of frames and of foam ticks, from a sea whose spectrum is baked beside the frames
// that show other seas.
#pragma once

#include <cstddef>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/cascades/packed_spectrum.hpp"
#include "pelagic/sim/cascades/pass.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

class Arrival;

/// A moment of the sea: the two of its ocean's seas that are blended, by number, and the weight of the second (Forecast).
struct SeaMoment {
    double time_s = 0;
    std::size_t before = 0, after = 0;
    double part = 0;  ///< weight of `after`, below 1; 0 if both are one sea
    /// Null if all waves have that weight. Otherwise each band has its own, and `part` is that of the waves at the swell's peak.
    const Arrival* arrival = nullptr;
    double since_s = 0;  ///< since the change began

    /// The waves of one sea, as they were baked.
    bool is_steady() const { return before == after; }
};

/// The stages after which a cascade's displacement and velocity are complete.
struct FilledBy {
    StageId displacement;
    StageId velocity;  ///< equals `displacement` without velocities, or where one stage computes both
};

class SeaSource {
   public:
    virtual ~SeaSource() = default;

    /// Adds the stages of a pass, which fill the buffers of the source's cascade in the back slot at the time they run.
    /// The source outlives the graph's runs.
    virtual FilledBy add_stages(JobGraph& graph, Pass pass, const std::vector<StageId>& waits_for) = 0;
    /// Sets what the next run of the pass's stages computes, and the cascade's description. \pre no run of the pass is in flight
    virtual void begin(Pass pass, const SeaMoment& moment, Cascade& cascade) = 0;
    /// Returns the extremes of the last run.
    virtual FrameBounds end_frame() = 0;

    /// Adds the one stage of a spectrum.
    virtual void add_spectrum_stage(JobGraph& graph) = 0;
    /// Sets what the next run of the spectrum's stage bakes; adopt_spectrum() makes it available to frames. A source has
    /// no waves before the first adoption. \pre the plan has the resolution of the slots, and the sea the source's wave model
    /// \param whitecap_cover  fraction of the sea that the cascade's breaking waves cover with foam, 0 for none
    virtual void begin_spectrum(const SeaState& sea, const CascadePlan& plan, double whitecap_cover) = 0;
    /// Stores the baked waves under a sea's number and returns their statistics. They replace what was in that place; all seas that
    /// are kept have one grid and one loop period. \pre place < SpectrumCache::places, and no pass in flight reads that place
    virtual LineStatistics adopt_spectrum(std::size_t number, std::size_t place) = 0;
    /// The statistics by bands of frequency; null for seas without transitions. \pre the place holds a sea
    virtual const StatisticsByBand* statistics_by_band(std::size_t) const { return nullptr; }
    virtual const CascadeGrid& grid() const = 0;  ///< of the frames to come
    virtual void drop_spectrum() = 0;             ///< discards what is being baked
    /// Swaps what was baked with what is staged, so that another spectrum can be baked meanwhile.
    virtual void stage_spectrum() = 0;
    virtual void forget_seas() = 0;

    virtual std::size_t bytes() const = 0;
};

}  // namespace pelagic
