#include "pelagic/sim/sources/weather.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "pelagic/sim/spectrum/whitecaps.hpp"
#include "pelagic/sim/spectrum/wind_drift.hpp"

namespace pelagic {
namespace {

/// A sea is baked so long before frames need it: hundreds of frames, each of which leaves the threads some time.
constexpr double bake_ahead_s = 10;

/// A live ocean's: the sea that a frame in flight or a tick before it may still show.
constexpr std::size_t remembered_changes = 2;

int white_tiles_of(const SeaState& sea, const WaveReach& reach) {
    const std::vector<TilePlan> plans = plan_tiles(sea, reach);
    return static_cast<int>(
        std::count_if(plans.begin(), plans.end(), [](const TilePlan& plan) { return plan.makes_whitecaps(); }));
}

}  // namespace

Weather::Weather(const Forecast& forecast) : forecast_(forecast), reach_(reach_of(forecast)) {
    forecast_.largest_peak_m = reach_.peak_m;
}

Forecast Weather::with(const SeaChange& change, std::size_t* first_number) const {
    Forecast longer = forecast_;
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
    return forecast_.changes.size() < remembered_changes ? never : forecast_.changes.front().end_s();
}

SeaMoment Weather::moment_at(double time_s) const {
    const ForecastMoment moment = forecast_.at(time_s);
    return {.time_s = time_s,
            .before = first_number_ + moment.before,
            .after = first_number_ + moment.after,
            .part = moment.part};
}

SeaState Weather::sea_at(const SeaMoment& moment) const {
    return sea_between(sea(moment.before), sea(moment.after), moment.part);
}

SeaFigures Weather::figures_at(const SeaMoment& moment) const {
    const Baked &before = baked_[*shelf_.find(moment.before)], &after = baked_[*shelf_.find(moment.after)];
    if (moment.is_steady()) return before.figures;
    const auto blend = [&](double Sums::*number) {
        return (1 - moment.part) * (before.sums.*number) + moment.part * (after.sums.*number);
    };
    Sums sums{.height_variance = blend(&Sums::height_variance),
              .slopes = before.sums.slopes * (1 - moment.part),
              .drift_x_mps = blend(&Sums::drift_x_mps),
              .drift_z_mps = blend(&Sums::drift_z_mps)};
    sums.slopes += after.sums.slopes * moment.part;
    SeaFigures figures = figures_of(sea_at(moment), sums);
    figures.roughness = (1 - moment.part) * before.figures.roughness + moment.part * after.figures.roughness;
    return figures;
}

SeaFigures Weather::figures_of(const SeaState& sea, const Sums& sums) {
    SeaFigures figures;
    figures.significant_wave_height_m = 4 * std::sqrt(sums.height_variance);
    figures.resolved_slopes = sums.slopes.around(sea.wind_direction_rad);
    figures.unresolved_slopes = slopes_left(sea, figures.resolved_slopes);
    figures.roughness = roughness_of(sea, figures.unresolved_slopes);
    figures.foam_drift_x_mps = sums.drift_x_mps;
    figures.foam_drift_z_mps = sums.drift_z_mps;
    return figures;
}

std::optional<std::size_t> Weather::wanted_soon(double time_s) const {
    const auto& changes = forecast_.changes;
    for (std::size_t i = 0; i < changes.size(); ++i) {
        if (changes[i].from_s > time_s + bake_ahead_s) break;
        if (changes[i].end_s() < time_s - bake_ahead_s) continue;
        for (const std::size_t number : {first_number_ + i, first_number_ + i + 1})
            if (!has(number)) return number;
    }
    return {};
}

void Weather::begin(const SeaState& sea, const WaveReach& reach, Sources sources) {
    const std::vector<TilePlan> plans = plan_tiles(sea, reach);
    const double cover = cover_of_each(whitecap_cover(sea), white_tiles_of(sea, reach));
    for (std::size_t tile = 0; tile < plans.size(); ++tile)
        sources[tile]->begin_spectrum(sea, plans[tile], plans[tile].makes_whitecaps() ? cover : 0);
}

void Weather::begin(std::size_t number, Sources sources) {
    begin(sea(number), reach_, sources);
    baked_number_ = number;
}

void Weather::adopt(Sources sources) {
    const SeaState& baked = sea(baked_number_);
    const std::size_t place = shelf_.put(baked_number_);
    Sums sums;
    for (const auto& source : sources) {
        const LineFigures added = source->adopt_spectrum(baked_number_, place);
        sums.height_variance += added.height_variance;
        sums.slopes += added.slopes.in_world(source->lattice());
        const TileLattice::Place stokes = source->lattice().in_world(added.stokes_x, added.stokes_z);
        sums.drift_x_mps += stokes.along;
        sums.drift_z_mps += stokes.across;
    }
    const WindDrift wind = wind_drift(baked);
    sums.drift_x_mps += wind.x_mps;
    sums.drift_z_mps += wind.z_mps;
    baked_[place] = {sums, figures_of(baked, sums)};
}

void Weather::begin_other(const SeaState& sea, Sources sources) {
    Forecast forecast{.first = sea};
    other_.emplace(Other{forecast, WaveReach::of(sea)});
    begin(sea, other_->reach, sources);
}

void Weather::restart(Sources sources) {
    first_number_ += forecast_.changes.size() + 1;
    forecast_ = other_->forecast;
    reach_ = other_->reach;
    forecast_.largest_peak_m = reach_.peak_m;
    other_.reset();
    shelf_.clear();
    for (const auto& source : sources) source->forget_seas();
    baked_number_ = first_number_;
    adopt(sources);
}

}  // namespace pelagic
