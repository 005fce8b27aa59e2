// Water at its drawn position, from the displacement of each cascade at its reference position.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/query/foam_sampler.hpp"
#include "pelagic/sim/query/shore_weights.hpp"
#include "pelagic/sim/surface/cascade_sum.hpp"

namespace pelagic::python {

struct DrawnWater {
    Displacement displacement;  ///< of the cascades, dynamic waves and the shore
    FoamWeights weights;        ///< weights of the cascades
};

/// Returns the water that has the reference position (x_m, z_m), in metres.
///
/// A shore's weights are those at the drawn position, which depends on them. They change over
/// lengths much larger than the displacement, so an iteration converges (sea.vert.glsl).
/// \param of_cascades  the displacement of each cascade
inline DrawnWater drawn_water(const Frame& frame, double x_m, double z_m, std::span<const Displacement> of_cascades) {
    constexpr int max_rounds = 64;
    constexpr double same_m = 1e-9;
    DrawnWater drawn{.displacement = {}, .weights = {}};
    drawn.weights.fill(1);
    const auto sum = [&] {
        Displacement all;
        for (std::size_t t = 0; t < of_cascades.size(); ++t) {
            const double weight = drawn.weights[t];
            all.dx += weight * of_cascades[t].dx;
            all.height += weight * of_cascades[t].height;
            all.dz += weight * of_cascades[t].dz;
        }
        return all;
    };
    const auto weigh = [&](double x, double z) {
        const ShoreAt at(frame.shore, x, z);
        for (std::size_t t = 0; t < of_cascades.size(); ++t) drawn.weights[t] = static_cast<float>(at.weight(t));
    };
    if (frame.shore) weigh(x_m, z_m);
    Displacement& d = drawn.displacement;
    d = sum();
    for (int round = 0; frame.shore && round < max_rounds; ++round) {
        weigh(x_m + d.dx, z_m + d.dz);
        const Displacement before = d;
        d = sum();
        if (std::fabs(d.dx - before.dx) + std::fabs(d.dz - before.dz) <= same_m) break;
    }
    const double x = x_m + d.dx, z = z_m + d.dz;
    if (frame.shore) d.height += ShoreAt(frame.shore, x, z).cubic(frame.shore.height_m).value;
    if (frame.dynamic_waves) d.height += sample(frame.dynamic_waves, x, z).height_m;
    return drawn;
}

/// Returns whether the frame has foam: of its cascades, of dynamic waves or of a shore.
inline bool has_foam(const Frame& frame) {
    return FoamSampler(frame).has_foam() || frame.dynamic_waves || frame.shore;
}

/// Returns the foam of dynamic waves and of the shore at a drawn position, in [0, 1].
inline double foam_of_place(const Frame& frame, double x_m, double z_m) {
    double foam = sample(frame.dynamic_waves, x_m, z_m).foam;
    if (frame.shore)
        if (const ShoreAt at(frame.shore, x_m, z_m); at.is_within()) foam = std::max(foam, at.foam());
    return foam;
}

/// Returns the velocity of dynamic waves and of the shore at a drawn position, m/s along x, y, z.
inline std::array<double, 3> velocity_of_place(const Frame& frame, double x_m, double z_m) {
    std::array<double, 3> sum = {0, sample(frame.dynamic_waves, x_m, z_m).vertical_velocity_mps, 0};
    if (!frame.shore) return sum;
    const ShoreAt shore(frame.shore, x_m, z_m);
    const auto [x_mps, z_mps] = shore.velocity();
    return {x_mps, sum[1] + shore.cubic(frame.shore.vertical_velocity_mps).value, z_mps};
}

}  // namespace pelagic::python
