// Random positions, and buffers for all results of a query at them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <random>
#include <vector>

#include "pelagic/sim/surface_query.hpp"

namespace pelagic {

struct Points {
    std::vector<double> x, z;
    SurfacePoints view() const { return {x, z}; }
};

inline Points random_points(std::size_t count, double reach_m, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> anywhere(-reach_m, reach_m);
    Points points;
    for (std::size_t i = 0; i < count; ++i) {
        points.x.push_back(anywhere(random));
        points.z.push_back(anywhere(random));
    }
    return points;
}

struct Samples {
    explicit Samples(std::size_t count, bool velocities = true, bool has_foam = false)
        : height(count),
          normal_x(count),
          normal_y(count),
          normal_z(count),
          jacobian(count),
          velocity_x(velocities ? count : 0),
          velocity_y(velocity_x),
          velocity_z(velocity_x),
          error(count),
          foam(has_foam ? count : 0),
          converged(count) {}
    SurfaceSamples view() {
        return {height,     normal_x,   normal_y, normal_z,  jacobian, velocity_x,
                velocity_y, velocity_z, error,    converged, foam};
    }
    bool operator==(const Samples&) const = default;
    std::vector<float> height, normal_x, normal_y, normal_z, jacobian, velocity_x, velocity_y, velocity_z, error,
        foam;
    std::vector<std::uint8_t> converged;
};

}  // namespace pelagic
