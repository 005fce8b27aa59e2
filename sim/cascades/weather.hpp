// Which sea there is when, and whose waves are at hand: a forecast, and what its seas make of the sources.
//
// Seas are numbered for the life of an ocean, so that one that is forgotten is never taken for another.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/cascades/arrival.hpp"
#include "pelagic/sim/cascades/sea_source.hpp"
#include "pelagic/sim/cascades/spectrum_cache.hpp"
#include "pelagic/sim/forecast.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/spectrum/mean_square_slope.hpp"

namespace pelagic {

class Weather {
   public:
    using Sources = std::span<const std::unique_ptr<SeaSource>>;

    /// \pre check(forecast) is empty
    explicit Weather(const Forecast& forecast);

    /// That of frames to come. Says how long peaks may be, too.
    const Forecast& forecast() const { return next_.forecast; }

    /// A frame in flight keeps the forecast that it was scheduled in, until need_nothing(). \pre check(with(change)) is empty
    void add(const SeaChange& change);
    /// The forecast after one more change; it remembers two. `first_number` counts what it forgets.
    Forecast with(const SeaChange& change, std::size_t* first_number = nullptr) const;

    /// Before that the weather is forgotten with the next change; no time if nothing is.
    double end_of_forgotten_by_next() const;

    /// Of ticks as of frames.
    SeaMoment moment_at(double time_s) const;
    SeaState sea_at(const SeaMoment& moment) const;
    /// \pre the moment's seas are at hand
    SeaStatistics statistics_at(const SeaMoment& moment) const;

    /// The next run of the pass takes what the moment needs.
    void need(Pass pass, const SeaMoment& moment) { cache_.need(pass, moment.before, moment.after); }
    /// No frame is in flight.
    void need_nothing() {
        cache_.need_nothing();
        in_flight_.reset();
    }
    std::size_t number_of_last() const { return next_.first_number + next_.forecast.changes.size(); }
    bool has(std::size_t number) const { return cache_.holds(number); }
    /// A sea that is not at hand, and that frames around this one will need.
    std::optional<std::size_t> wanted_soon(double time_s) const;

    /// What the next run of the sources' stages `spectrum` bakes: a sea of the forecast, which adopt() puts at hand, or
    void begin(std::size_t number, Sources sources);
    void adopt(Sources sources);
    /// the only sea of another weather, which starts with restart(). Until then frames show this one, and seas of it may be baked
    /// once the other's spectrum is set aside.
    void begin_other(const SeaState& sea, Sources sources);
    void restart(Sources sources);

   private:
    /// What all cascades of a sea add up to.
    struct Sums {
        double height_variance = 0;
        SlopeMoments slopes;                      ///< in the world's axes
        double drift_x_mps = 0, drift_z_mps = 0;  ///< of foam

        Sums& operator+=(const Sums& other);
        static Sums between(const Sums& before, const Sums& after, double part);
        /// The drift is Stokes'.
        static Sums of(const LineStatistics& statistics, const CascadeGrid& grid);
    };
    struct Baked {
        Sums sums;
        Sums wind;                  ///< what the wind adds to them
        std::vector<Sums> by_band;  ///< what waves add to them, by bands of frequency
        SeaStatistics statistics;   ///< of this sea alone
    };
    /// Another weather, whose sea is being baked.
    struct Other {
        Forecast forecast;
        WaveReach reach;
        std::vector<CascadePlan> plans;
    };

    /// A forecast, and what follows from it.
    struct Outlook {
        Forecast forecast;
        /// Of each sea: to find one out takes longer than a frame has time for.
        std::vector<std::vector<CascadePlan>> plans = {};
        /// Of each change; none: all of its waves come together.
        std::vector<std::optional<Arrival>> arrivals = {};
        std::size_t first_number = 0;  ///< of forecast.first

        const SeaState& sea(std::size_t number) const { return forecast.sea(number - first_number); }
        void find_arrivals();
    };
    /// That of the frame in flight, or of the next one.
    const Outlook& now() const { return in_flight_ ? *in_flight_ : next_; }
    /// One that knows the sea.
    const Outlook& outlook_of(std::size_t number) const { return number < next_.first_number ? now() : next_; }
    const SeaState& sea(std::size_t number) const { return outlook_of(number).sea(number); }
    static Sums arriving(const Baked& before, const Baked& after, const SeaMoment& moment);
    static SeaStatistics statistics_of(const SeaState& sea, const Sums& sums);
    void begin(const SeaState& sea, const std::vector<CascadePlan>& plans, Sources sources);

    WaveReach reach_;
    Outlook next_;                      ///< of frames to come
    std::optional<Outlook> in_flight_;  ///< of the frame in flight, if changes were added since it was scheduled
    SpectrumCache cache_;
    std::array<Baked, SpectrumCache::places> baked_;
    std::size_t baked_number_ = 0;
    std::optional<Other> other_;
};

}  // namespace pelagic
