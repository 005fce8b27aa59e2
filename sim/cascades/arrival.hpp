// A change whose waves come one after the other, in bands of frequency.
#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "pelagic/sim/cascades/packed_spectrum.hpp"
#include "pelagic/sim/forecast.hpp"
#include "pelagic/sim/spectrum/swell_arrival.hpp"

namespace pelagic {

class Arrival {
   public:
    /// \pre change.swell_from_m > 0, and a forecast with it passes check()
    explicit Arrival(const SeaChange& change);

    /// Bands beyond come with the last one of these.
    std::size_t bands() const { return delays_s_.size(); }
    /// s of a band's waves, so long after the change begins.
    double part(std::size_t band, double since_s) const {
        return eased_part(since_s - delays_s_[std::min(band, bands() - 1)], over_s_);
    }

   private:
    double over_s_;
    std::vector<double> delays_s_;
};

/// What a cascade's waves add to the sea meanwhile: each band blends by itself, so that the figures are those of the waves.
LineStatistics between(const StatisticsByBand& before, const StatisticsByBand& after, const Arrival& arrival,
                       double since_s);

}  // namespace pelagic
