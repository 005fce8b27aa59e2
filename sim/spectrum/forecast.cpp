#include "pelagic/sim/forecast.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string_view>

#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/sim/spectrum/swell_arrival.hpp"
#include "pelagic/sim/spectrum/system_spectrum.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

using std::numbers::pi;

constexpr double max_time_s = 1e12;  // limit of a resolution of about 1e-4 s in double precision
constexpr double longest_change_s = 1e9;
constexpr double min_swell_from_m = 1e3, max_swell_from_m = 2e7;  // half the earth's circumference
constexpr double max_peak_m = 1e5;

/// Relative tolerance for equal peaks: the accuracy of peak_of().
constexpr double peak_tolerance = 1e-6;

std::string of_change(std::string_view name, std::size_t number) {
    return "change " + number_text(number) + ": " + std::string(name);
}

/// Returns a message about the first field that must be constant in a forecast and differs in
/// `sea`.
std::string difference(const SeaState& first, const SeaState& sea, std::size_t number) {
    const auto refused = [&](std::string_view name, const auto& is, const std::string& needed) {
        return invalid_value_message(of_change(name, number), is, needed + " as the first sea has it");
    };
    if (first.waves != sea.waves) return refused("waves", name_of(sea.waves), std::string(name_of(first.waves)));
    // Octaves of a pond displace one another, so they have no independent energies to blend.
    if (is_of_fixed_model(sea))
        return invalid_value_message(of_change("waves", number), name_of(sea.waves),
                                     std::string("spectrum or analytic: a ") +
                                         (sea.waves == WaveModel::pond ? "pond" : "regular wave") +
                                         " does not change");
    if (is_phillips_paper(first) != is_phillips_paper(sea))
        return refused("spectrum", name_of(sea.spectrum),
                       is_phillips_paper(first) ? "phillips-paper" : "a physical one");
    struct Fixed {
        std::string_view name;
        double first, is;
    };
    for (const Fixed& fixed : std::array{
             Fixed{"patch_size_m", first.patch_size_m, sea.patch_size_m},
             Fixed{"cascades", static_cast<double>(cascades_of(first)), static_cast<double>(cascades_of(sea))},
             Fixed{"resolution", static_cast<double>(resolution_of(first)), static_cast<double>(resolution_of(sea))},
             Fixed{"depth_m", first.depth_m, sea.depth_m},
             Fixed{"loop_period_s", first.loop_period_s, sea.loop_period_s},
             Fixed{"seed", static_cast<double>(first.seed), static_cast<double>(sea.seed)}})
        if (fixed.first != fixed.is) return refused(fixed.name, fixed.is, number_text(fixed.first));
    return {};
}

std::string too_long(const std::string& prefix, const SeaState& sea, std::optional<double> largest_peak_m) {
    if (!largest_peak_m) return {};  // skip the search for the peak, which is expensive
    const double peak_m = WaveReach::of(sea).peak_m;
    if (peak_m <= *largest_peak_m * (1 + peak_tolerance)) return {};
    return invalid_value_message(
        prefix + "peak_wavelength_m", peak_m,
        "at most " + number_text(*largest_peak_m) + ", the largest_peak_m that cascades are laid out for");
}

double number_between(double before, double after, double weight) {
    return before == after ? before : (1 - weight) * before + weight * after;
}

/// Returns the direction between two directions along the shorter arc, in [-2 pi, 2 pi].
double direction_between(double before, double after, double weight) {
    double turn = after - before;
    while (turn > pi) turn -= two_pi;
    while (turn <= -pi) turn += two_pi;
    double direction = before + weight * turn;
    if (direction > two_pi) direction -= two_pi;
    if (direction < -two_pi) direction += two_pi;
    return direction;
}

}  // namespace

double SeaChange::end_s() const {
    const double over = from_s + over_s;
    return swell_from_m ? over + SwellArrival(sea, *swell_from_m).span_s() : over;
}

ForecastMoment Forecast::at(double time_s) const {
    const DefaultFloatEnvironment environment(time_s);
    const auto next = std::upper_bound(changes.begin(), changes.end(), time_s,
                                       [](double time, const SeaChange& change) { return time < change.from_s; });
    const auto number = static_cast<std::size_t>(next - changes.begin());
    if (number == 0) return {};
    const SeaChange& change = changes[number - 1];
    const double since_s = time_s - change.from_s;
    if (change.swell_from_m) {
        if (since_s <= 0) return {number - 1, number - 1, 0};
        if (time_s >= change.end_s()) return {number, number, 0};
        const SwellArrival swell(change.sea, *change.swell_from_m);
        return {number - 1, number, eased_fraction(since_s - swell.delay_of_peak_s(), change.over_s)};
    }
    const double weight = eased_fraction(since_s, change.over_s);
    if (weight >= 1) return {number, number, 0};
    if (weight <= 0) return {number - 1, number - 1, 0};
    return {number - 1, number, weight};
}

void keep_constant_fields(SeaState& sea, const SeaState& first) {
    const SeaState defaults;
    const auto keep = [&](auto... members) {
        ((sea.*members == defaults.*members ? void(sea.*members = first.*members) : void()), ...);
    };
    keep(&SeaState::cascades, &SeaState::resolution, &SeaState::patch_size_m, &SeaState::depth_m,
         &SeaState::loop_period_s, &SeaState::seed);
}

std::string check(const Forecast& forecast) {
    if (const std::string reason = check(forecast.first); !reason.empty()) return "first sea: " + reason;
    const std::optional<double> largest_m = forecast.largest_peak_m;
    if (largest_m && !(*largest_m > 0 && *largest_m <= max_peak_m))
        return invalid_value_message("largest_peak_m", *largest_m, "(0, 1e5]");
    if (std::string reason = too_long("first sea: ", forecast.first, largest_m); !reason.empty()) return reason;
    double over_s = -max_time_s;  // end of the previous change
    for (std::size_t i = 0; i < forecast.changes.size(); ++i) {
        const SeaChange& change = forecast.changes[i];
        const std::size_t number = i + 1;
        if (const std::string reason = check(change.sea); !reason.empty())
            return "change " + number_text(number) + ": " + reason;
        if (std::string reason = difference(forecast.first, change.sea, number); !reason.empty()) return reason;
        if (std::string reason = too_long("change " + number_text(number) + ": ", change.sea, largest_m);
            !reason.empty())
            return reason;
        if (!(change.over_s > 0 && change.over_s <= longest_change_s))
            return invalid_value_message(of_change("over_s", number), change.over_s, "(0, 1e9]");
        if (const std::optional<double> afar = change.swell_from_m) {
            if (!(*afar >= min_swell_from_m && *afar <= max_swell_from_m))
                return invalid_value_message(of_change("swell_from_m", number), *afar, "[1e3, 2e7]");
            if (!(period_of_swell_s(change.sea) > 0))
                return invalid_value_message(of_change("swell_from_m", number), *afar,
                                             "none where the sea has no swell");
        }
        if (!(change.from_s >= over_s && change.from_s <= max_time_s))
            return invalid_value_message(
                of_change("from_s", number), change.from_s,
                i == 0 ? "[-1e12, 1e12]" : "at least " + number_text(over_s) + ", when the change before is over");
        over_s = change.end_s();
    }
    return {};
}

std::vector<WaveReach> own_reaches(const Forecast& forecast) {
    std::vector<WaveReach> own = {WaveReach::of(forecast.first)};
    for (const SeaChange& change : forecast.changes) own.push_back(WaveReach::of(change.sea));
    return own;
}

WaveReach reach_of(const Forecast& forecast) { return reach_of(forecast, own_reaches(forecast)); }

WaveReach reach_of(const Forecast& forecast, std::span<const WaveReach> own) {
    WaveReach reach;
    for (const WaveReach& sea : own) reach.extend_to(sea);
    if (forecast.largest_peak_m && reach.peak_m > 0) reach.peak_m = *forecast.largest_peak_m;
    return reach;
}

std::vector<CascadePlan> plan_cascades(const Forecast& forecast) {
    return plan_cascades(forecast.first, reach_of(forecast));
}

std::string warning_about(const Forecast& forecast) {
    const auto shortest_m = [](const std::vector<CascadePlan>& plans) {
        return 2 * plans.back().grid.side_m / plans.back().resolution;
    };
    const double shared_m = shortest_m(plan_cascades(forecast)), alone_m = shortest_m(plan_cascades(forecast.first));
    if (shared_m < 2 * alone_m) return {};
    return "cascades for a peak wavelength of " + rounded_text(reach_of(forecast).peak_m, 3) +
           " m hold no waves shorter than " + rounded_text(shared_m, 2) + " m, where the first sea alone has " +
           rounded_text(alone_m, 2) + " m: raise the resolution";
}

SeaState sea_between(const SeaState& before, const SeaState& after, double weight) {
    const DefaultFloatEnvironment environment(weight);
    if (weight == 0) return before;
    if (weight == 1) return after;
    SeaState sea = weight < 0.5 ? before : after;
    for (const SeaStateField& field : sea_state_fields())
        if (const auto* number = std::get_if<double SeaState::*>(&field.member))
            // A special value (`also`, such as 0 for "chosen") cannot be interpolated.
            if (before.**number != field.also && after.**number != field.also)
                sea.** number = number_between(before.**number, after.**number, weight);
    sea.wind_direction_rad = direction_between(before.wind_direction_rad, after.wind_direction_rad, weight);
    if (is_by_height(wind_sea_of(sea))) sea.fetch_m = SeaState{}.fetch_m;  // check() accepts no other
    if (before.roughness < 0 || after.roughness < 0) sea.roughness = std::max(before.roughness, after.roughness);

    if (before.swell_height_m > 0 && after.swell_height_m > 0) {
        const auto energy = [](const SeaState& of) { return of.swell_height_m * of.swell_height_m; };
        sea.swell_height_m = std::sqrt(number_between(energy(before), energy(after), weight));
        sea.swell_direction_rad = direction_between(before.swell_direction_rad, after.swell_direction_rad, weight);
    } else {
        const bool comes = after.swell_height_m > 0;
        const SeaState& swell = comes ? after : before;
        sea.swell_height_m = swell.swell_height_m * std::sqrt(comes ? weight : 1 - weight);
        sea.swell_period_s = swell.swell_period_s;
        sea.swell_direction_rad = swell.swell_direction_rad;
        sea.swell_spread_rad = swell.swell_spread_rad;
    }
    return sea;
}

}  // namespace pelagic
