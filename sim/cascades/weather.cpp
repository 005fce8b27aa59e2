#include "pelagic/sim/cascades/weather.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/sim/kernels/harmonic_bands.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/foam_front.hpp"
#include "pelagic/sim/spectrum/wind_drift.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

/// Time before its first use at which baking a sea starts. It spans hundreds of frames, in whose
/// idle time the sea is baked.
constexpr double bake_ahead_s = 10;

/// Foam needs larger deviations: the bytes of slopes would be too coarse.
constexpr double min_compression_deviation = 1e-4;
/// Smaller deviations from the mean over a square do not change its foam.
constexpr double min_left_out = 0.1;

/// Changes kept by add(): their seas cover a frame in flight and the ticks before it.
constexpr std::size_t remembered_changes = 2;

/// Returns what later seas must keep to; unset if one cascade has a given side.
std::optional<double> largest_peak_m(const WaveReach& reach) {
    return reach.peak_m > 0 ? std::optional(reach.peak_m) : std::nullopt;
}

}  // namespace

Weather::Weather(const Forecast& forecast) : next_{.forecast = forecast} {
    const std::vector<WaveReach> own = own_reaches(forecast);
    reach_ = reach_of(forecast, own);
    next_.forecast.largest_peak_m = largest_peak_m(reach_);
    for (std::size_t index = 0; index <= forecast.changes.size(); ++index)
        next_.plans.push_back(plan_cascades(forecast.sea(index), reach_, own[index]));
    next_.find_arrivals();
}

void Weather::Outlook::find_arrivals() {
    arrivals.clear();
    for (const SeaChange& change : forecast.changes)
        arrivals.push_back(change.swell_from_m ? std::optional<Arrival>(change) : std::nullopt);
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
    front_x += other.front_x;
    front_z += other.front_z;
    whitecaps += other.whitecaps;
    const auto add = [](Compression& to, const Compression& more) {
        to.square += more.square;
        to.rate_square += more.rate_square;
    };
    add(compression, other.compression);
    compression_drop_x += other.compression_drop_x;
    compression_drop_z += other.compression_drop_z;
    for (std::size_t width = 0; width < compression_of_width.size(); ++width)
        add(compression_of_width[width], other.compression_of_width[width]);
    for (std::size_t tick = 0; tick < contraction.size(); ++tick) contraction[tick] += other.contraction[tick];
    return *this;
}

Weather::Sums Weather::Sums::between(const Sums& before, const Sums& after, double weight) {
    const auto blend = [&](double Sums::*number) {
        return (1 - weight) * (before.*number) + weight * (after.*number);
    };
    Sums sums{.height_variance = blend(&Sums::height_variance),
              .slopes = before.slopes * (1 - weight),
              .drift_x_mps = blend(&Sums::drift_x_mps),
              .drift_z_mps = blend(&Sums::drift_z_mps),
              .front_x = blend(&Sums::front_x),
              .front_z = blend(&Sums::front_z),
              .whitecaps = blend(&Sums::whitecaps),
              .compression = {},
              .compression_drop_x = blend(&Sums::compression_drop_x),
              .compression_drop_z = blend(&Sums::compression_drop_z),
              .compression_of_width = {},
              .contraction = {}};
    const auto between_both = [&](const Compression& a, const Compression& b) {
        return Compression{(1 - weight) * a.square + weight * b.square,
                           (1 - weight) * a.rate_square + weight * b.rate_square};
    };
    sums.compression = between_both(before.compression, after.compression);
    for (std::size_t width = 0; width < FoamFilter::widths; ++width)
        sums.compression_of_width[width] =
            between_both(before.compression_of_width[width], after.compression_of_width[width]);
    for (std::size_t tick = 0; tick < sums.contraction.size(); ++tick)
        sums.contraction[tick] = (1 - weight) * before.contraction[tick] + weight * after.contraction[tick];
    sums.slopes += after.slopes * weight;
    return sums;
}

Weather::Sums Weather::Sums::of(const LineStatistics& statistics, const CascadeGrid& grid) {
    const CascadeGrid::Vector stokes = grid.in_world(statistics.stokes_x, statistics.stokes_z);
    return {.height_variance = statistics.height_variance,
            .slopes = statistics.slopes.in_world(grid),
            .drift_x_mps = stokes.along,
            .drift_z_mps = stokes.across,
            .front_x = 0,
            .front_z = 0,
            .whitecaps = 0,
            .compression = {},
            .compression_drop_x = 0,
            .compression_drop_z = 0,
            .compression_of_width = {},
            .contraction = {}};
}

/// Adds the compression of a frequency band. The mean over a square of width w, interpolated
/// between such squares, attenuates waves as a Gaussian does: their mean square by exp(-k^2 w^2 /
/// 3) (measured; a box alone gives 1/12). The finest squares are the texels, whose filter the
/// statistics include.
void Weather::Sums::add_foam_of(const LineStatistics& band, const CascadePlan& plan, double frequency_radps,
                                double drift_of_usual, double tick_s) {
    if (!(plan.foam_weight() > 0 && band.compression_square > 0)) return;
    const double square = plan.foam_weight() * plan.foam_weight() * band.compression_square;
    // The moments hold the frequency that foam of the usual drift meets.
    const double met_radps = std::sqrt(band.compression_rate_square / band.compression_square);
    const double rate_radps = frequency_radps + drift_of_usual * (met_radps - frequency_radps);
    const Compression all{square, square * rate_radps * rate_radps};
    const double k = frequency_radps * frequency_radps / gravity_mps2, texel_m = plan.grid.side_m / plan.resolution;
    compression.square += all.square;
    compression.rate_square += all.rate_square;
    compression_drop_x += plan.foam_weight() * plan.foam_weight() * band.compression_drop_x;
    compression_drop_z += plan.foam_weight() * plan.foam_weight() * band.compression_drop_z;
    for (std::size_t tick = 0; tick < contraction.size(); ++tick) {
        const auto before = det::sine_cosine_of_turns(static_cast<double>(tick) * tick_s * rate_radps / two_pi);
        contraction[tick] += plan.foam_weight() * band.contraction * before.cosine +
                             plan.foam_weight() * band.contraction_before * before.sine;
    }
    for (std::size_t width = 0; width < FoamFilter::widths; ++width) {
        const double width_m = std::ldexp(FoamFilter::first_width_m, static_cast<int>(width));
        const double kept = det::exp(-k * k * std::max(width_m * width_m - texel_m * texel_m, 0.0) / 3);
        compression_of_width[width].square += kept * all.square;
        compression_of_width[width].rate_square += kept * all.rate_square;
    }
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

namespace {

// Two corrections of the formula of foam/accumulation.hpp for a single cascade. In a stack, waves of
// finer cascades hide the first, and are too fast for the second.

/// Returns the level of a single cascade. Its shortest waves, which compress the water most, are as
/// short as its texels resolve. So more of their variance is left on lines of texels than midway
/// between them, in proportion to 2 u (1 - u), whose variance is 1/45. A Gaussian of such a variance
/// has an excess kurtosis of three times the relative variance of the variance, and this quantile
/// (Cornish and Fisher 1938).
/// \param level           of a Gaussian
/// \param drop_x, drop_z  Sums::compression_drop_x and _z over the variance
double level_of_one_cascade(double level, double drop_x, double drop_z) {
    const double excess = 3 * 4 * (drop_x * drop_x + drop_z * drop_z) / 45;
    return level + excess / 24 * (level * level * level - 3 * level);
}

/// Returns the cover for which the formula gives the level of `cover`. The formula takes crossings as
/// independent, but those of one group of waves are a period apart, so their foam overlaps less. This
/// counts where waves are slow, so that foam fades within a period, and where the cover is large. The
/// factors are measured, at 7 to 26 m/s.
/// \param fall  c of the formula: 0.04 to 0.12, the larger the slower the waves
double formula_cover_of_one_cascade(double cover, double fall) {
    return cover * (1 - 0.35 * fall - 0.06 * cover);
}

}  // namespace

void Weather::add_foam_statistics(const SeaState& sea, const Sums& sums, SeaStatistics& statistics) {
    const auto& [all, all_rates] = sums.compression;
    const double cover = sums.whitecaps * whitecap_cover(sea.wind_speed_mps);
    const double tick_s = TickClock(sea.loop_period_s).tick_s();
    statistics.compression_deviation = sea.choppiness * std::sqrt(all);
    if (!(cover > 0 && statistics.compression_deviation >= min_compression_deviation)) return;
    FoamAccumulation::Contraction contraction = sums.contraction;
    for (double& covariance : contraction) covariance *= sea.choppiness / std::sqrt(all);
    const bool is_one = cascades_of(sea) == 1;
    const FoamAccumulation formula(std::sqrt(all_rates / all), tick_s);
    statistics.foam_level = formula.level_of_area(
        is_one ? formula_cover_of_one_cascade(cover, formula.fall()) : cover, contraction);
    if (is_one)
        statistics.foam_level = level_of_one_cascade(statistics.foam_level, sums.compression_drop_x / all,
                                                     sums.compression_drop_z / all);
    // Narrow squares leave out little, and take the parabola of a wider one.
    for (std::size_t width = FoamFilter::widths; width-- > 0;) {
        const auto& [kept, kept_rates] = sums.compression_of_width[width];
        FoamFilter& filter = statistics.foam_filters[width];
        if (width + 1 < FoamFilter::widths) filter = statistics.foam_filters[width + 1];
        const double rest = std::max(all - kept, 0.0), deviation = std::sqrt(rest / all);
        filter.deviation = static_cast<float>(deviation);
        if (deviation < min_left_out) continue;
        const FoamAccumulation foam(std::sqrt(std::max(all_rates - kept_rates, 0.0) / rest), tick_s,
                                    FoamAccumulation::ramp_deviations / deviation);
        const auto log_count = [&](double x) { return det::log(-det::log(1 - foam.cover(x))); };
        const double y_0 = log_count(0.5), y_1 = log_count(2), y_2 = log_count(3.5);
        const double slope = (y_2 - y_0) / 3, bend = (y_2 - 2 * y_1 + y_0) / 4.5;
        filter.a = static_cast<float>(y_1 - 2 * slope + 4 * bend);
        filter.b = static_cast<float>(slope - 4 * bend);
        filter.c = static_cast<float>(bend);
    }
}

SeaStatistics Weather::statistics_of(const SeaState& sea, const Sums& sums) {
    SeaStatistics statistics;
    statistics.significant_wave_height_m = 4 * std::sqrt(sums.height_variance);
    statistics.resolved_slopes = sums.slopes.around(sea.wind_direction_rad);
    statistics.unresolved_slopes = unresolved_slopes(sea, statistics.resolved_slopes);
    statistics.roughness = roughness_of(sea, statistics.unresolved_slopes);
    statistics.foam_drift_x_mps = sums.drift_x_mps;
    statistics.foam_drift_z_mps = sums.drift_z_mps;
    statistics.foam_front_x = sea.choppiness * sums.front_x;
    statistics.foam_front_z = sea.choppiness * sums.front_z;
    add_foam_statistics(sea, sums, statistics);
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
    for (std::size_t cascade = 0; cascade < plans.size(); ++cascade)
        sources[cascade]->begin_spectrum(sea, plans[cascade]);
}

void Weather::begin(std::size_t number, Sources sources) {
    const DefaultFloatEnvironment environment;
    begin(sea(number), plans(number), sources);
    baked_number_ = number;
}

void Weather::adopt(Sources sources) {
    const DefaultFloatEnvironment environment;
    const SeaState& baked = sea(baked_number_);
    const std::size_t entry = cache_.put(baked_number_);
    Sums sums;
    std::vector<Sums> by_band;
    for (std::size_t cascade = 0; cascade < sources.size(); ++cascade)
        sums += Sums::of(sources[cascade]->adopt_spectrum(baked_number_, entry), sources[cascade]->grid());
    const WindDrift wind = wind_drift(baked), usual = usual_foam_drift(baked);
    const FoamFront front = foam_front(baked);
    Sums by_wind;
    by_wind.drift_x_mps = wind.x_mps;
    by_wind.drift_z_mps = wind.z_mps;
    by_wind.front_x = front.x;
    by_wind.front_z = front.z;
    by_wind.whitecaps = has_whitecaps(baked) ? 1 : 0;
    sums += by_wind;
    const double usual_square = usual.x_mps * usual.x_mps + usual.z_mps * usual.z_mps;
    constexpr double no_drift_m2ps2 = 1e-12;
    const double drift_of_usual =
        usual_square > no_drift_m2ps2
            ? (sums.drift_x_mps * usual.x_mps + sums.drift_z_mps * usual.z_mps) / usual_square
            : 1;
    const double tick_s = TickClock(baked.loop_period_s).tick_s();
    for (std::size_t cascade = 0; cascade < sources.size(); ++cascade) {
        const StatisticsByBand* const bands = sources[cascade]->statistics_by_band(entry);
        if (!bands) continue;
        by_band.resize(std::max(by_band.size(), bands->end()));
        for (std::size_t band = bands->first(); band < bands->end(); ++band) {
            const double frequency = two_pi / baked.loop_period_s * middle_harmonic(band);
            Sums foam;
            foam.add_foam_of(bands->at(band), plans(baked_number_)[cascade], frequency, drift_of_usual, tick_s);
            sums += foam;
            by_band[band] += Sums::of(bands->at(band), sources[cascade]->grid());
            by_band[band] += foam;
        }
    }
    baked_[entry] = {sums, by_wind, std::move(by_band), statistics_of(baked, sums)};
}

void Weather::begin_other(const SeaState& sea, Sources sources) {
    const DefaultFloatEnvironment environment;
    Forecast forecast{.first = sea};
    other_.emplace(Other{forecast, WaveReach::of(sea), plan_cascades(sea)});
    begin(sea, other_->plans, sources);
}

void Weather::restart(Sources sources) {
    next_ = {.forecast = other_->forecast, .plans = {other_->plans}, .first_number = number_of_last() + 1};
    reach_ = other_->reach;
    next_.forecast.largest_peak_m = largest_peak_m(reach_);
    other_.reset();
    cache_.clear();
    for (const auto& source : sources) source->forget_seas();
    baked_number_ = next_.first_number;
    adopt(sources);
}

}  // namespace pelagic
