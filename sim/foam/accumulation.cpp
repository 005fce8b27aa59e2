#include "pelagic/sim/foam/accumulation.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/sim/dispersion.hpp"
#include "pelagic/sim/foam/tick_clock.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {

static_assert(FoamAccumulation::fading_ticks == TickClock::kept_ticks - 1);

namespace {

/// Returns the density of the standard normal distribution.
double density(double x) { return 0.39894228040143267794 * det::exp(-x * x / 2); }

/// Returns its upper tail probability (Abramowitz and Stegun 1964, 26.2.17; error below 7.5e-8).
double tail_probability(double x) {
    if (x < 0) return 1 - tail_probability(-x);
    const double t = 1 / (1 + 0.2316419 * x);
    return density(x) * t *
           (0.319381530 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
}

/// Gauss-Legendre nodes on [0, 1], for the integral over foam.
struct Node {
    double foam, weight;
};
constexpr Node nodes[] = {{0.11270166537925831, 5.0 / 18}, {0.5, 8.0 / 18}, {0.88729833462074169, 5.0 / 18}};

/// Returns the approximate level of a Gaussian with this tail probability, if it is small. The
/// result is nearly linear in the level. The cover of an area leaves [0, 1] where a sea folds over
/// itself, because the contraction there is that of small waves.
double rarity(double cover) { return std::sqrt(-2 * det::log(std::clamp(cover, 1e-300, 1.0))); }

/// Returns k at an age of [0, 15] ticks.
double at_age(const FoamAccumulation::Contraction& contraction, double ticks) {
    const std::size_t before = std::min(static_cast<std::size_t>(ticks), contraction.size() - 2);
    const double after = contraction[before + 1] - contraction[before];
    return contraction[before] + (ticks - static_cast<double>(before)) * after;
}

}  // namespace

double whitecap_cover(double wind_speed_mps) {
    // Below the minimum, waves are invisible and the power would underflow.
    constexpr double min_wind_mps = 0.01;
    return std::min(0.4, 3.84e-6 * det::pow(std::max(wind_speed_mps, min_wind_mps), 3.41));
}

bool has_whitecaps(const SeaState& sea) {
    if (sea.waves != WaveModel::spectrum) return false;
    return sea.spectrum != SpectrumModel::none ||
           std::any_of(sea.systems.begin(), sea.systems.end(), [&](const WaveSystem& system) {
               if (!(system.peak_period_s > 0)) return true;  // by wind, or as high as by a wind
               const double omega = two_pi / system.peak_period_s;
               const double speed_mps = omega / wave_number(omega, sea.depth_m);
               const double along =
                   det::sine_cosine_of_turns((system.direction_rad - sea.wind_direction_rad) / two_pi).cosine;
               return speed_mps < 1.2 * sea.wind_speed_mps * along;
           });
}

double whitecap_cover(const SeaState& sea) { return has_whitecaps(sea) ? whitecap_cover(sea.wind_speed_mps) : 0; }

FoamAccumulation::FoamAccumulation(double frequency_radps, double tick_s, double ramp)
    : ramp_(ramp),
      half_turn_of_tick_(frequency_radps * tick_s / 2),
      fall_(ramp / (fading_ticks * tick_s * frequency_radps)),
      crossings_(density(fall_) / fall_ + (1 - tail_probability(fall_))) {}

double FoamAccumulation::sampled(double level) const {
    const double r = level * half_turn_of_tick_;
    return r < 1e-3 ? 1 : 2.50662827463100050242 * (0.5 - tail_probability(r)) / r;
}

double FoamAccumulation::cover(double level) const {
    const double seen = sampled(level);
    const double all_white = tail_probability(level + ramp_ / 2);
    double cover = 0;
    for (const Node& node : nodes) {
        const double white = tail_probability(level + ramp_ * (node.foam - 0.5));
        const double crossings = seen * crossings_ * (white - all_white);
        cover += node.weight * (1 - (1 - all_white) * det::exp(-crossings / (1 - all_white)));
    }
    return cover;
}

double FoamAccumulation::cover_of_area(double level, const Contraction& contraction) const {
    const auto hazard = [](double boundary) { return density(boundary) / (1 - tail_probability(boundary)); };
    const double seen = sampled(level), white = level + ramp_ / 2;
    const double below_white = 1 - tail_probability(white), hazard_white = hazard(white);
    double cover = 0;
    for (const Node& node : nodes) {
        const double now = level + ramp_ * (node.foam - 0.5), oldest = (1 - node.foam) * fading_ticks;
        const double below = 1 - tail_probability(now);
        const double none = below_white * det::exp(seen * crossings_ * det::log(below / below_white));
        // Simpson's rule over the boundary. The age is linear in it: w p(c) da = p(c) / c db.
        constexpr int steps = 8;
        double by_age = 0;
        for (int step = 0; step <= steps; ++step) {
            const double part = static_cast<double>(step) / steps, boundary = now + part * (white - now);
            const double weight = step == 0 || step == steps ? 1 : step % 2 == 0 ? 2 : 4;
            const double rate = hazard(boundary);
            by_age += weight * (boundary + rate) * rate * at_age(contraction, part * oldest);
        }
        by_age *= density(fall_) / fall_ * (white - now) / (3 * steps);
        const double old = hazard_white * at_age(contraction, oldest);
        const double change =
            old + seen * (by_age + (1 - tail_probability(fall_)) * (hazard(now) * contraction[0] - old));
        cover += node.weight * (1 - none * (1 + change));
    }
    return cover;
}

// Secant method; the rarity is nearly linear in the level.
double FoamAccumulation::level_of_area(double target, const Contraction& contraction) const {
    const double goal = rarity(target);
    double last = 1, level = 3;
    double last_rarity = rarity(cover_of_area(last, contraction));
    for (int step = 0; step < 5; ++step) {
        const double level_rarity = rarity(cover_of_area(level, contraction));
        if (level_rarity == last_rarity) break;
        const double next = level + (goal - level_rarity) * (level - last) / (level_rarity - last_rarity);
        last = level;
        last_rarity = level_rarity;
        level = std::clamp(next, 0.0, 9.0);
    }
    return level;
}

}  // namespace pelagic
