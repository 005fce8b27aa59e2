#include "pelagic/sim/cascades/weather.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pelagic/sim/foam/whitecaps.hpp"
#include "pelagic/sim/spectrum/wind_drift.hpp"

namespace pelagic {
namespace {

/// Time before its first use at which baking a sea starts. It spans hundreds of frames, in whose
/// idle time the sea is baked.
constexpr double bake_ahead_s = 10;

/// Changes kept by add(): their seas cover a frame in flight and the ticks before it.
constexpr std::size_t remembered_changes = 2;

int white_cascades_of(const std::vector<CascadePlan>& plans) {
    return static_cast<int>(
        std::count_if(plans.begin(), plans.end(), [](const CascadePlan& plan) { return plan.makes_whitecaps(); }));
}

}  // namespace

Weather::Weather(const Forecast& forecast) : next_{.forecast = forecast} {
    const std::vector<WaveReach> own = own_reaches(forecast);
    reach_ = reach_of(forecast, own);
    next_.forecast.largest_peak_m = reach_.peak_m;
    for (std::size_t index = 0; index <= forecast.changes.size(); ++index)
        next_.plans.push_back(plan_cascades(forecast.sea(index), reach_, own[index]));
    next_.find_arrivals();
}

void Weather::Outlook::find_arrivals() {
    arrivals.clear();
    for (const SeaChange& change : forecast.changes)
        arrivals.push_back(change.swell_from_m > 0 ? std::optional<Arrival>(change) : std::nullopt);
}

void Weather::add(const SeaChange& change) {
    Outlook next = next_;
    next.forecast = with(change, &next.first_number);
    next.plans.erase(next.plans.begin(),
                     next.plans.begin() + static_cast<std::ptrdiff_t>(next.first_number - next_.first_number));
    next.plans.push_back(plan_cascades(change.sea, reach_));
    next.find_arrivals();
    std::swap(next_, next);
    if (cache_.needs_any() && !in_flight_) in_flight_ = std::move(next);
}

Forecast Weather::with(const SeaChange& change, std::size_t* first_number) const {
    Forecast longer = forecast();
    if (longer.changes.size() >= remembered_changes) {
        longer.first = longer.changes.front().sea;
        longer.changes.erase(longer.changes.begin());
        if (first_number) ++*first_number;
    }
    longer.changes.push_back(change);
    return longer;
}

double Weather::end_of_forgotten_by_next() const {
    constexpr double never = -std::numeric_limits<double>::infinity();
    return forecast().changes.size() < remembered_changes ? never : forecast().changes.front().end_s();
}

SeaMoment Weather::moment_at(double time_s) const {
    const Outlook& outlook = now();
    const ForecastMoment found = outlook.forecast.at(time_s);
    SeaMoment moment{.time_s = time_s,
                     .before = outlook.first_number + found.before,
                     .after = outlook.first_number + found.after,
                     .weight = found.weight};
    if (moment.is_steady()) return moment;
    if (const std::optional<Arrival>& arrival = outlook.arrivals[found.before]) moment.arrival = &*arrival;
    moment.since_s = time_s - outlook.forecast.changes[found.before].from_s;
    return moment;
}

SeaState Weather::sea_at(const SeaMoment& moment) const {
    return sea_between(sea(moment.before), sea(moment.after), moment.weight);
}

SeaStatistics Weather::statistics_at(const SeaMoment& moment) const {
    const Baked &before = baked_[*cache_.find(moment.before)], &after = baked_[*cache_.find(moment.after)];
    if (moment.is_steady()) return before.statistics;
    const Sums sums =
        moment.arrival ? arriving(before, after, moment) : Sums::between(before.sums, after.sums, moment.weight);
    SeaStatistics statistics = statistics_of(sea_at(moment), sums);
    statistics.roughness =
        (1 - moment.weight) * before.statistics.roughness + moment.weight * after.statistics.roughness;
    return statistics;
}

Weather::Sums& Weather::Sums::operator+=(const Sums& other) {
    height_variance += other.height_variance;
    slopes += other.slopes;
    drift_x_mps += other.drift_x_mps;
    drift_z_mps += other.drift_z_mps;
    return *this;
}

Weather::Sums Weather::Sums::between(const Sums& before, const Sums& after, double weight) {
    const auto blend = [&](double Sums::*number) {
        return (1 - weight) * (before.*number) + weight * (after.*number);
    };
    Sums sums{.height_variance = blend(&Sums::height_variance),
              .slopes = before.slopes * (1 - weight),
              .drift_x_mps = blend(&Sums::drift_x_mps),
              .drift_z_mps = blend(&Sums::drift_z_mps)};
    sums.slopes += after.slopes * weight;
    return sums;
}

Weather::Sums Weather::Sums::of(const LineStatistics& statistics, const CascadeGrid& grid) {
    const CascadeGrid::Place stokes = grid.in_world(statistics.stokes_x, statistics.stokes_z);
    return {statistics.height_variance, statistics.slopes.in_world(grid), stokes.along, stokes.across};
}

/// Blends each band with its own weight, and the wind with the weight of the swell's peak (as
/// sea_at()).
Weather::Sums Weather::arriving(const Baked& before, const Baked& after, const SeaMoment& moment) {
    Sums sums = Sums::between(before.wind, after.wind, moment.weight);
    for (std::size_t band = 0; band < std::max(before.by_band.size(), after.by_band.size()); ++band) {
        const auto of = [&](const Baked& sea) { return band < sea.by_band.size() ? sea.by_band[band] : Sums(); };
        sums += Sums::between(of(before), of(after), moment.arrival->fraction(band, moment.since_s));
    }
    return sums;
}

SeaStatistics Weather::statistics_of(const SeaState& sea, const Sums& sums) {
    SeaStatistics statistics;
    statistics.significant_wave_height_m = 4 * std::sqrt(sums.height_variance);
    statistics.resolved_slopes = sums.slopes.around(sea.wind_direction_rad);
    statistics.unresolved_slopes = unresolved_slopes(sea, statistics.resolved_slopes);
    statistics.roughness = roughness_of(sea, statistics.unresolved_slopes);
    statistics.foam_drift_x_mps = sums.drift_x_mps;
    statistics.foam_drift_z_mps = sums.drift_z_mps;
    return statistics;
}

std::optional<std::size_t> Weather::wanted_soon(double time_s) const {
    const auto& changes = forecast().changes;
    for (std::size_t i = 0; i < changes.size(); ++i) {
        if (changes[i].from_s > time_s + bake_ahead_s) break;
        if (changes[i].end_s() < time_s - bake_ahead_s) continue;
        for (const std::size_t number : {next_.first_number + i, next_.first_number + i + 1})
            if (!has(number)) return number;
    }
    return {};
}

void Weather::begin(const SeaState& sea, const std::vector<CascadePlan>& plans, Sources sources) {
    const double cover = cover_of_each(whitecap_cover(sea), white_cascades_of(plans));
    for (std::size_t cascade = 0; cascade < plans.size(); ++cascade)
        sources[cascade]->begin_spectrum(sea, plans[cascade], plans[cascade].makes_whitecaps() ? cover : 0);
}

void Weather::begin(std::size_t number, Sources sources) {
    const Outlook& outlook = outlook_of(number);
    begin(outlook.sea(number), outlook.plans[number - outlook.first_number], sources);
    baked_number_ = number;
}

void Weather::adopt(Sources sources) {
    const SeaState& baked = sea(baked_number_);
    const std::size_t place = cache_.put(baked_number_);
    Sums sums;
    std::vector<Sums> by_band;
    for (const auto& source : sources) {
        const LineStatistics added = source->adopt_spectrum(baked_number_, place);
        sums += Sums::of(added, source->grid());
        const StatisticsByBand* const bands = source->statistics_by_band(place);
        if (!bands) continue;
        by_band.resize(std::max(by_band.size(), bands->end()));
        for (std::size_t band = bands->first(); band < bands->end(); ++band)
            by_band[band] += Sums::of(bands->at(band), source->grid());
    }
    const WindDrift wind = wind_drift(baked);
    sums.drift_x_mps += wind.x_mps;
    sums.drift_z_mps += wind.z_mps;
    const Sums by_wind{0, {}, wind.x_mps, wind.z_mps};
    baked_[place] = {sums, by_wind, std::move(by_band), statistics_of(baked, sums)};
}

void Weather::begin_other(const SeaState& sea, Sources sources) {
    Forecast forecast{.first = sea};
    other_.emplace(Other{forecast, WaveReach::of(sea), plan_cascades(sea)});
    begin(sea, other_->plans, sources);
}

void Weather::restart(Sources sources) {
    next_ = {.forecast = other_->forecast, .plans = {other_->plans}, .first_number = number_of_last() + 1};
    reach_ = other_->reach;
    next_.forecast.largest_peak_m = reach_.peak_m;
    other_.reset();
    cache_.clear();
    for (const auto& source : sources) source->forget_seas();
    baked_number_ = next_.first_number;
    adopt(sources);
}

}  // namespace pelagic
