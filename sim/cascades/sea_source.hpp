// Interface of the sources of a cascade's displacement, for frames and foam ticks. A source bakes
// the spectrum of one sea while frames use other seas.
#pragma once

#include <cstddef>
#include <vector>

#include "pelagic/jobs/job_graph.hpp"
#include "pelagic/sim/buffers/frame_part.hpp"
#include "pelagic/sim/buffers/pass.hpp"
#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/cascades/packed_spectrum.hpp"
#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

class Arrival;

/// State of the sea at a time: the numbers of the two seas that are blended, and the weight of the
/// second (Forecast).
struct SeaMoment {
    double time_s = 0;
    std::size_t before = 0, after = 0;
    double weight = 0;  ///< weight of `after`, below 1; 0 if both are one sea
    /// Weight of each frequency band. Null if all waves have one weight, `weight`. Otherwise
    /// `weight` is that of the waves at the swell's peak.
    const Arrival* arrival = nullptr;
    double since_s = 0;           ///< time since the change began
    bool whitecaps_only = false;  ///< PassMoment::whitecaps_only

    /// Returns whether the moment has the waves of one sea, without a blend.
    bool is_steady() const { return before == after; }
};

/// A source whose columns are transformed by stage `columns+textures` of a frame.
class ColumnSource {
   public:
    virtual ~ColumnSource() = default;
    /// Adds only the stage that computes the lines (kernels/wave_blocks.hpp).
    virtual StageId add_line_stage(JobGraph& graph, Pass pass, const std::vector<StageId>& waits_for) = 0;
    /// Transforms a pair of column blocks (column_block_pair()) of the frame, in place.
    /// \pre the lines are complete
    virtual void transform(std::size_t pair) = 0;
};

/// Fills the displacement of a cascade.
class SeaSource {
   public:
    virtual ~SeaSource() = default;

    /// Adds the stages of a pass. They fill the buffers of the source's cascade in the slot that is
    /// the back slot when they run. \pre the source outlives the graph's runs
    virtual FilledBy add_stages(JobGraph& graph, Pass pass, const std::vector<StageId>& waits_for) = 0;
    /// Returns the source's columns; null if it computes displacement without lines.
    virtual ColumnSource* columns() { return nullptr; }
    /// Sets the moment that the next run of the pass's stages computes, and fills in the
    /// description of the cascade. \pre no run of the pass is in flight
    virtual void begin(Pass pass, const SeaMoment& moment, Cascade& cascade) = 0;
    /// Returns the extremes of the last frame.
    virtual FrameBounds end_frame() = 0;

    /// Adds the stage that bakes a spectrum.
    virtual void add_spectrum_stage(JobGraph& graph) = 0;
    /// Sets the sea that the next run of the spectrum's stage bakes. adopt_spectrum() makes it
    /// available to frames. A source has no waves before the first adoption.
    /// \pre the plan has the resolution of the slots, and the sea has the source's wave model
    virtual void begin_spectrum(const SeaState& sea, const CascadePlan& plan) = 0;
    /// Stores the baked waves under a sea's number, replaces the waves of that entry, and returns
    /// their statistics. All stored seas have one grid and one loop period.
    /// \pre entry < SpectrumCache::entries, and no pass in flight reads that entry
    virtual LineStatistics adopt_spectrum(std::size_t number, std::size_t entry) = 0;
    /// Returns the statistics by frequency band; null if the source has no transitions.
    /// \pre the entry holds a sea
    virtual const StatisticsByBand* statistics_by_band(std::size_t) const { return nullptr; }
    virtual const CascadeGrid& grid() const = 0;  ///< of the next frames
    virtual void drop_spectrum() = 0;             ///< discards the spectrum being baked
    /// Exchanges the baked spectrum with the staged one, so that another spectrum can be baked.
    virtual void stage_spectrum() = 0;
    virtual void forget_seas() = 0;  ///< discards the waves of all adopted seas

    virtual std::size_t bytes() const = 0;
};

}  // namespace pelagic
