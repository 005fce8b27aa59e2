// Frames with velocities that are not from an ocean: still water, and a regular wave.
#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "pelagic/sim/buffers/fold_map.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/tests/one_cascade_frame.hpp"

namespace pelagic {

class StillWater {
   public:
    explicit StillWater(int n = 16, double side_m = 64)
        : n_(n),
          side_m_(side_m),
          height_(cells()),
          velocity_x_(cells()),
          velocity_y_(cells()),
          zero_(cells()),
          folds_(n) {
        const auto plane = [&](std::vector<float>& values) { return PlaneView{values.data(), n_, n_, n_, 0}; };
        water_.frame.isa = choose_isa();
        Cascade& cascade = water_.cascade;
        cascade.grid.side_m = side_m;
        cascade.dx = cascade.dz = plane(zero_);
        cascade.height = plane(height_);
        cascade.velocity_x = plane(velocity_x_);
        cascade.velocity_y = plane(velocity_y_);
        cascade.velocity_z = plane(zero_);
        folds_.update(cascade, kernels_for(choose_isa()));
    }

    const Frame& frame() const { return water_.frame; }
    SurfaceQuery query() const { return SurfaceQuery(frame()); }

   protected:
    std::size_t cells() const { return static_cast<std::size_t>(n_) * static_cast<std::size_t>(n_); }

    int n_;
    double side_m_;
    std::vector<float> height_, velocity_x_, velocity_y_, zero_;
    FoldMap folds_;
    OneCascadeFrame water_;
};

/// A regular wave of small amplitude along x, h = a cos(k x - omega t), in deep water.
class RegularWave : public StillWater {
   public:
    using StillWater::StillWater;

    /// \param waves  whole number of wavelengths in the side
    void set_wave(double amplitude_m, int waves, double time_s) {
        const double k = two_pi * waves / side_m_, omega = std::sqrt(gravity_mps2 * k);
        for (int i = 0; i < n_; ++i) {
            const double phase = k * i * side_m_ / n_ - omega * time_s;
            for (int j = 0; j < n_; ++j) {
                const auto at = static_cast<std::size_t>(j * n_ + i);
                height_[at] = static_cast<float>(amplitude_m * std::cos(phase));
                velocity_x_[at] = static_cast<float>(amplitude_m * omega * std::cos(phase));
                velocity_y_[at] = static_cast<float>(amplitude_m * omega * std::sin(phase));
            }
        }
    }
};

}  // namespace pelagic
