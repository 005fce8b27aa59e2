#include "pelagic/sim/foam/accumulation.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {

static_assert(FoamAccumulation::fading_ticks == 255.0 / FoamTickJob::fade);

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
/// result is nearly linear in the level.
double rarity(double cover) { return std::sqrt(-2 * det::log(cover)); }

}  // namespace

FoamAccumulation::FoamAccumulation(double frequency_radps, double tick_s, double ramp)
    : ramp_(ramp), half_turn_of_tick_(frequency_radps * tick_s / 2) {
    const double fall = ramp / (fading_ticks * tick_s * frequency_radps);
    crossings_ = density(fall) / fall + (1 - tail_probability(fall));
}

double FoamAccumulation::cover(double level) const {
    const double r = level * half_turn_of_tick_;
    const double seen = r < 1e-3 ? 1 : 2.50662827463100050242 * (0.5 - tail_probability(r)) / r;
    const double all_white = tail_probability(level + ramp_ / 2);
    double cover = 0;
    for (const Node& node : nodes) {
        const double white = tail_probability(level + ramp_ * (node.foam - 0.5));
        const double crossings = seen * crossings_ * (white - all_white);
        cover += node.weight * (1 - (1 - all_white) * det::exp(-crossings / (1 - all_white)));
    }
    return cover;
}

// Secant method; rarity(cover(level)) is nearly linear.
double FoamAccumulation::level_of(double target) const {
    const double goal = rarity(target);
    double last = 1, level = 3;
    double last_rarity = rarity(cover(last));
    for (int step = 0; step < 5; ++step) {
        const double level_rarity = rarity(cover(level));
        if (level_rarity == last_rarity) break;
        const double next = level + (goal - level_rarity) * (level - last) / (level_rarity - last_rarity);
        last = level;
        last_rarity = level_rarity;
        level = std::clamp(next, 0.0, 9.0);
    }
    return level;
}

}  // namespace pelagic
