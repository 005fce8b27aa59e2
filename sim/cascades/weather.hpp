// The forecast of an ocean, and the baked waves and statistics of its seas.
//
// Each sea has a number that is unique for the life of the ocean.
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
#include "pelagic/sim/foam/accumulation.hpp"
#include "pelagic/sim/forecast.hpp"
#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/spectrum/mean_square_slope.hpp"

namespace pelagic {

class Weather {
   public:
    using Sources = std::span<const std::unique_ptr<SeaSource>>;

    /// \pre check(forecast) is empty
    explicit Weather(const Forecast& forecast);

    /// Returns the forecast of the next frames, with largest_peak_m set.
    const Forecast& forecast() const { return next_.forecast; }

    /// Appends a change. A frame in flight keeps its forecast until need_nothing().
    /// \pre check(with(change)) is empty
    void add(const SeaChange& change);
    /// Returns the forecast with one more change. It keeps two changes: a third replaces the first.
    /// \param first_number  incremented if a change is dropped; may be null
    Forecast with(const SeaChange& change, std::size_t* first_number = nullptr) const;

    /// Returns the end of the change that the next add() drops, in seconds: no frame before it can
    /// be computed afterwards. Returns -infinity if add() drops none.
    double end_of_forgotten_by_next() const;

    /// Returns the two seas and the weight at a time, for frames and for ticks.
    SeaMoment moment_at(double time_s) const;
    SeaState sea_at(const SeaMoment& moment) const;
    /// \pre has() is true for both seas of the moment
    SeaStatistics statistics_at(const SeaMoment& moment) const;

    /// Returns CascadePlan::foam_weight() of a cascade, or 0 if no sea of the forecast has
    /// whitecaps.
    double foam_weight(std::size_t cascade) const {
        return now().forecast.first.waves == WaveModel::spectrum ? now().plans.front()[cascade].foam_weight() : 0;
    }

    /// Marks the moment's seas as needed by the next run of the pass.
    void need(Pass pass, const SeaMoment& moment) { cache_.need(pass, moment.before, moment.after); }
    /// Releases the seas and the forecast of the last frame. \pre no frame is in flight
    void need_nothing() {
        cache_.need_nothing();
        in_flight_.reset();
    }
    std::size_t number_of_last() const { return next_.first_number + next_.forecast.changes.size(); }
    bool has(std::size_t number) const { return cache_.holds(number); }
    /// Returns a sea that frames near this time need and that is not baked; empty if none is.
    std::optional<std::size_t> wanted_soon(double time_s) const;

    /// Sets the next run of the stages `spectrum` to bake a sea of the forecast.
    void begin(std::size_t number, Sources sources);
    /// Stores the sea that was baked after begin(), for use by frames.
    void adopt(Sources sources);
    /// Sets the next run of the stages `spectrum` to bake the only sea of a new forecast. Until
    /// restart(), frames use the current forecast. Its seas can be baked after the sources have
    /// staged the new spectrum (SeaSource::stage_spectrum()).
    void begin_other(const SeaState& sea, Sources sources);
    /// Replaces the forecast with the one of begin_other().
    void restart(Sources sources);

   private:
    /// Sums over the cascades of a sea.
    struct Sums {
        double height_variance = 0;
        SlopeMoments slopes;                      ///< in the world's axes
        double drift_x_mps = 0, drift_z_mps = 0;  ///< of foam
        double front_x = 0, front_z = 0;          ///< foam_front()
        double whitecaps = 0;                     ///< 1 if has_whitecaps(), else 0
        /// Mean squares of the weighted compression at choppiness 1, and of its rate of change.
        struct Compression {
            double square = 0, rate_square = 0;
        } compression;
        double compression_drop_x = 0, compression_drop_z = 0;  ///< as of LineStatistics
        /// Mean squares of their means over squares of FoamFilter's widths.
        std::array<Compression, FoamFilter::widths> compression_of_width;
        /// Covariances of the contraction with the weighted compression, by its age in foam ticks.
        FoamAccumulation::Contraction contraction{};

        /// \param drift_of_usual  drift of the sea's foam along usual_foam_drift(), divided by it
        void add_foam_of(const LineStatistics& band, const CascadePlan& plan, double frequency_radps,
                         double drift_of_usual, double tick_s);
        Sums& operator+=(const Sums& other);
        static Sums between(const Sums& before, const Sums& after, double weight);
        /// Returns the sums of a cascade, with the Stokes drift as the drift.
        static Sums of(const LineStatistics& statistics, const CascadeGrid& grid);
    };
    struct Baked {
        Sums sums;                  ///< of wind and waves
        Sums wind;                  ///< contribution of the wind
        std::vector<Sums> by_band;  ///< contribution of the waves, by frequency band
        SeaStatistics statistics;   ///< of this sea, outside transitions
    };
    /// New forecast, whose sea is being baked.
    struct Other {
        Forecast forecast;
        WaveReach reach;
        std::vector<CascadePlan> plans;
    };

    /// A forecast and the data derived from it.
    struct Outlook {
        Forecast forecast;
        /// By sea. Kept, because computing a plan takes longer than a frame may.
        std::vector<std::vector<CascadePlan>> plans = {};
        /// By change; empty if all of its waves change together.
        std::vector<std::optional<Arrival>> arrivals = {};
        std::size_t first_number = 0;  ///< of forecast.first

        const SeaState& sea(std::size_t number) const { return forecast.sea(number - first_number); }
        void find_arrivals();
    };
    /// Returns the outlook of the frame in flight, or else of the next frame.
    const Outlook& now() const { return in_flight_ ? *in_flight_ : next_; }
    /// Returns an outlook that contains the sea.
    const Outlook& outlook_of(std::size_t number) const { return number < next_.first_number ? now() : next_; }
    const SeaState& sea(std::size_t number) const { return outlook_of(number).sea(number); }
    const std::vector<CascadePlan>& plans(std::size_t number) const {
        return outlook_of(number).plans[number - outlook_of(number).first_number];
    }
    static Sums arriving(const Baked& before, const Baked& after, const SeaMoment& moment);
    static void add_foam_statistics(const SeaState& sea, const Sums& sums, SeaStatistics& statistics);
    static SeaStatistics statistics_of(const SeaState& sea, const Sums& sums);
    void begin(const SeaState& sea, const std::vector<CascadePlan>& plans, Sources sources);

    WaveReach reach_;
    Outlook next_;  ///< of the next frames
    /// Of the frame in flight, if changes were added since it was scheduled.
    std::optional<Outlook> in_flight_;
    SpectrumCache cache_;
    std::array<Baked, SpectrumCache::entries> baked_;
    std::size_t baked_number_ = 0;
    std::optional<Other> other_;
};

}  // namespace pelagic
