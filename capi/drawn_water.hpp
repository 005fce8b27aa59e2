// Water at its drawn position, from the displacement of each cascade at its reference position.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "pelagic/sim/cascade_sum.hpp"
#include "pelagic/sim/dynamic_waves.hpp"
#include "pelagic/sim/shore.hpp"

namespace pelagic::capi {

struct DrawnWater {
    Displacement displacement;                    ///< of the cascades, dynamic waves and the shore
    std::array<float, 4> weights = {1, 1, 1, 1};  ///< weights of the cascades
};

/// Returns the water that has the reference position (x_m, z_m), in metres.
///
/// A shore's weights are those at the drawn position, which depends on them. They change over
/// lengths much larger than the displacement, so an iteration converges (sea.vert.glsl).
inline DrawnWater drawn_water(const Frame& frame, double x_m, double z_m) {
    constexpr int max_rounds = 64;
    constexpr double same_m = 1e-9;
    std::array<Displacement, 4> of_cascades;
    for (std::size_t t = 0; t < frame.cascades.size(); ++t)
        of_cascades[t] = displacement_of(frame.cascades[t], x_m, z_m);
    DrawnWater drawn;
    const auto sum = [&] {
        Displacement all;
        for (std::size_t t = 0; t < frame.cascades.size(); ++t) {
            const double weight = drawn.weights[t];
            all.dx += weight * of_cascades[t].dx;
            all.height += weight * of_cascades[t].height;
            all.dz += weight * of_cascades[t].dz;
        }
        return all;
    };
    if (frame.shore) drawn.weights = shore_weights_at(frame.shore, x_m, z_m);
    Displacement& d = drawn.displacement;
    d = sum();
    for (int round = 0; frame.shore && round < max_rounds; ++round) {
        drawn.weights = shore_weights_at(frame.shore, x_m + d.dx, z_m + d.dz);
        const Displacement before = d;
        d = sum();
        if (std::fabs(d.dx - before.dx) + std::fabs(d.dz - before.dz) <= same_m) break;
    }
    const double x = x_m + d.dx, z = z_m + d.dz;
    if (frame.shore) d.height += sample(frame.shore, x, z).height_m;
    if (frame.dynamic_waves) d.height += sample(frame.dynamic_waves, x, z).height_m;
    return drawn;
}

/// Returns whether the frame has foam: of its cascades, of dynamic waves or of a shore.
inline bool has_foam(const Frame& frame) {
    return FoamSampler(frame).has_foam() || frame.dynamic_waves || frame.shore;
}

/// Returns the foam of dynamic waves and of the shore at a drawn position, in [0, 1].
inline double foam_of_place(const Frame& frame, double x_m, double z_m) {
    return std::max(sample(frame.dynamic_waves, x_m, z_m).foam, sample(frame.shore, x_m, z_m).foam);
}

/// Returns the velocity of dynamic waves and of the shore at a drawn position, m/s along x, y, z.
inline std::array<double, 3> velocity_of_place(const Frame& frame, double x_m, double z_m) {
    const ShoreSample shore = sample(frame.shore, x_m, z_m);
    return {shore.velocity_x_mps,
            sample(frame.dynamic_waves, x_m, z_m).vertical_velocity_mps + shore.vertical_velocity_mps,
            shore.velocity_z_mps};
}

}  // namespace pelagic::capi
