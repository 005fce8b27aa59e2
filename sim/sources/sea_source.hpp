// A source whose waves are those of seas, each baked beside the frames that show others.
#pragma once

#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/sources/packed_spectrum.hpp"
#include "pelagic/sim/sources/wave_source.hpp"
#include "pelagic/sim/cascade_plan.hpp"

namespace pelagic {

class SeaSource : public WaveSource {
   public:
    /// Adds the one stage of a spectrum.
    virtual void add_spectrum_stage(JobGraph& graph) = 0;
    /// What the next run of the spectrum's stage bakes; adopt_spectrum() makes it that of a sea of frames to come. A source has
    /// no waves before the first one. \pre the plan has the resolution of the slots, and the sea the kind of waves
    /// \param whitecap_cover  part of the sea that is to be white with what the cascade folds, 0 for none
    virtual void begin_spectrum(const SeaState& sea, const CascadePlan& plan, double whitecap_cover) = 0;
    /// Says what the new waves add to the sea, whose number moments name. What was in that place is gone; all seas that are kept
    /// have the same grid and loop. \pre place < SpectrumCache::places, and no pass in flight takes what is there
    virtual LineStatistics adopt_spectrum(std::size_t number, std::size_t place) = 0;
    /// The same by bands of frequency; null where no sea turns into another. \pre the place holds a sea
    virtual const StatisticsByBand* statistics_by_band(std::size_t) const { return nullptr; }
    virtual const CascadeGrid& grid() const = 0;  ///< of the frames to come
    virtual void drop_spectrum() = 0;                ///< keeps the waves as they are
    /// Keeps what was baked for later, and makes room for another one; and the other way round.
    virtual void stage_spectrum() = 0;
    virtual void forget_seas() = 0;
};

}  // namespace pelagic
