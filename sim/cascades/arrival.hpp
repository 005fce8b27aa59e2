// A sea-state transition whose waves arrive in bands of frequency, the longest first.
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
    /// \pre change.swell_from_m is set, and a forecast with the change passes check()
    explicit Arrival(const SeaChange& change);

    /// Returns the number of bands with their own delay. Higher bands arrive with the last one.
    std::size_t bands() const { return delays_s_.size(); }
    /// Returns the weight of the new sea for a band's waves, in [0, 1].
    /// \param since_s  seconds since the change began
    double fraction(std::size_t band, double since_s) const {
        return eased_fraction(since_s - delays_s_[std::min(band, bands() - 1)], over_s_);
    }

   private:
    double over_s_;
    std::vector<double> delays_s_;
};

/// Returns a cascade's statistics while waves arrive: each band is blended with its own weight.
/// \param since_s  seconds since the change began
LineStatistics between(const StatisticsByBand& before, const StatisticsByBand& after, const Arrival& arrival,
                       double since_s);

}  // namespace pelagic
