#include "pelagic/sim/query/height_change.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>

#include "pelagic/sim/buffers/surface_texels.hpp"

namespace pelagic {
namespace {

/// Lower bound of the slack, below which rounding of the contraction bounds matters.
constexpr double min_bound_slack = 1e-3;

/// Relative tolerance of a free distance.
constexpr double near_enough = 1.0 / 32;

/// Upper bound of the relative rounding error of float sums.
constexpr double rounding = 1 + 1e-5;

/// Returns the largest slope of a cascade's heights over reference points. All threads compute the
/// same value, so none has to wait for another.
double steepness_of(const Cascade& cascade, const Kernels& kernels) {
    std::atomic<float>* const known = cascade.contraction.steepness;
    float steepness = known ? known->load(std::memory_order_relaxed) : -1;
    if (steepness < 0) {
        steepness = kernels.steepness(
            {.surface = texels_of(cascade), .texels_per_m = static_cast<float>(1 / cascade.texel_m())});
        if (known) known->store(steepness, std::memory_order_relaxed);
    }
    return static_cast<double>(steepness) * rounding;
}

}  // namespace

HeightChange::HeightChange(std::span<const Cascade> cascades, const Kernels& kernels, double dynamic_waves_range_m,
                           double weights_change_per_m)
    : count_(cascades.size()), dynamic_waves_range_m_(dynamic_waves_range_m) {
    double slack = 1, further_m = 0;
    for (const Cascade& cascade : cascades) further_m += 2 * static_cast<double>(cascade.contraction.largest_m);
    for (std::size_t i = 0; i < count_; ++i) {
        const Cascade& cascade = cascades[i];
        bounds_[i] = {.steepness = steepness_of(cascade, kernels),
                      .range_m = static_cast<double>(cascade.bounds.height_max_m - cascade.bounds.height_min_m),
                      .slack = slack,
                      .further_m = further_m};
        stretch_ += weights_change_per_m * static_cast<double>(cascade.contraction.largest_m);
        highest_per_m_ +=
            weights_change_per_m * static_cast<double>(std::max(std::fabs(cascade.bounds.height_min_m),
                                                                std::fabs(cascade.bounds.height_max_m)));
        slack -= cascade.contraction.max();
        further_m = std::max(0.0, further_m - 2 * static_cast<double>(cascade.contraction.largest_m));
    }
    bounds_[count_] = {.steepness = 0, .range_m = 0, .slack = slack, .further_m = 0};
}

double HeightChange::within(double distance_m) const {
    const double stretched_m = stretch_ * distance_m;
    double reference_m = stretched_m + bounds_[0].further_m;
    for (std::size_t i = 1; i <= count_ && bounds_[i].slack >= min_bound_slack; ++i)
        reference_m = std::min(reference_m, (stretched_m + bounds_[i].further_m) / bounds_[i].slack);
    double change_m = dynamic_waves_range_m_ + highest_per_m_ * distance_m;
    for (std::size_t i = 0; i < count_; ++i)
        change_m += std::min(bounds_[i].steepness * reference_m, bounds_[i].range_m);
    return change_m;
}

double HeightChange::free_distance(double clearance_m, double horizontal, double vertical, double max_m) const {
    if (is_free(clearance_m, horizontal, vertical, max_m)) return max_m;
    double free_m = 0, end_m = std::max(0.0, vertical * max_m > clearance_m ? clearance_m / vertical : max_m);
    for (int halving = 0; halving < 20 && end_m - free_m > near_enough * end_m; ++halving) {
        const double middle_m = (free_m + end_m) / 2;
        (is_free(clearance_m, horizontal, vertical, middle_m) ? free_m : end_m) = middle_m;
    }
    return free_m;
}

}  // namespace pelagic
