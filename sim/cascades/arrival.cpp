#include "pelagic/sim/cascades/arrival.hpp"

#include "pelagic/sim/kernels/harmonic_bands.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/simd/constants.hpp"

namespace pelagic {

Arrival::Arrival(const SeaChange& change) : over_s_(change.over_s) {
    const SwellArrival swell(change.sea, change.swell_from_m.value());
    const double loop_s = change.sea.loop_period_s;
    delays_s_.resize(harmonic_band(loop_harmonic(swell.last_omega(), loop_s)) + 1);
    for (std::size_t band = 0; band < bands(); ++band)
        delays_s_[band] = swell.delay_s(two_pi / loop_s * middle_harmonic(band));
}

LineStatistics between(const StatisticsByBand& before, const StatisticsByBand& after, const Arrival& arrival,
                       double since_s) {
    LineStatistics sum;
    for (std::size_t band = std::min(before.first(), after.first()); band < std::max(before.end(), after.end());
         ++band)
        sum += between(before.at(band), after.at(band), arrival.fraction(band, since_s));
    return sum;
}

}  // namespace pelagic
