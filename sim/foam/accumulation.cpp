#include "pelagic/sim/foam/accumulation.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {

static_assert(FoamAccumulation::fading_ticks == 255.0 / FoamTickJob::fade);

namespace {

/// Density of the standard normal distribution.
double density(double x) { return 0.39894228040143267794 * det::exp(-x * x / 2); }

/// What lies above x of it. Abramowitz and Stegun 1964, 26.2.17: within 7.5e-8.
double part_above(double x) {
    if (x < 0) return 1 - part_above(-x);
    const double t = 1 / (1 + 0.2316419 * x);
    return density(x) * t *
           (0.319381530 + t * (-0.356563782 + t * (1.781477937 + t * (-1.821255978 + t * 1.330274429))));
}

/// Gauss and Legendre's points of foam in [0, 1].
struct Node {
    double foam, weight;
};
constexpr Node nodes[] = {{0.11270166537925831, 5.0 / 18}, {0.5, 8.0 / 18}, {0.88729833462074169, 5.0 / 18}};

/// Nearly linear in the level: a Gaussian's level where what lies above is small.
double rarity(double cover) { return std::sqrt(-2 * det::log(cover)); }

}  // namespace

FoamAccumulation::FoamAccumulation(double frequency_radps, double tick_s)
    : half_turn_of_tick_(frequency_radps * tick_s / 2) {
    const double fall = ramp_deviations / (fading_ticks * tick_s * frequency_radps);
    crossings_ = density(fall) / fall + (1 - part_above(fall));
}

double FoamAccumulation::cover(double level) const {
    const double r = level * half_turn_of_tick_;
    const double seen = r < 1e-3 ? 1 : 2.50662827463100050242 * (0.5 - part_above(r)) / r;
    const double all_white = part_above(level + ramp_deviations / 2);
    double cover = 0;
    for (const Node& node : nodes) {
        const double white = part_above(level + ramp_deviations * (node.foam - 0.5));
        const double crossings = seen * crossings_ * (white - all_white);
        cover += node.weight * (1 - (1 - all_white) * det::exp(-crossings / (1 - all_white)));
    }
    return cover;
}

// Secants; the line is nearly straight.
double FoamAccumulation::level_of(double wanted) const {
    const double goal = rarity(wanted);
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
