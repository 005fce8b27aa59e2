// Water in closed form: still, and a regular wave.
#pragma once

#include <algorithm>
#include <cmath>

#include "pelagic/sim/water_kinematics.hpp"
#include "pelagic/simd/constants.hpp"

namespace pelagic {

class StillWater : public WaterKinematics {
   public:
    explicit StillWater(double time_s = 0) : WaterKinematics(1025, time_s) {}

    const WaterKinematics& query() const { return *this; }
    double floor_m() const override { return -1e7; }
    void sample(const WaterPoints& points, const WaterSamples& samples) const override {
        for (std::size_t i = 0; i < points.x.size(); ++i) {
            const Motion motion = motion_at(points.x[i], points.y[i], points.z[i]);
            const auto put = [i](std::span<float> to, double value) {
                if (!to.empty()) to[i] = static_cast<float>(value);
            };
            put(samples.depth_m, motion.depth_m);
            put(samples.pressure_pa, 1025 * gravity_mps2 * (motion.head_m - points.y[i]));
            put(samples.velocity_x_mps, motion.along_mps * along_x_);
            put(samples.velocity_y_mps, motion.up_mps);
            put(samples.velocity_z_mps, motion.along_mps * along_z_);
            put(samples.acceleration_x_mps2, motion.along_mps2 * along_x_);
            put(samples.acceleration_y_mps2, motion.up_mps2);
            put(samples.acceleration_z_mps2, motion.along_mps2 * along_z_);
        }
    }

   protected:
    struct Motion {
        double depth_m, head_m = 0, along_mps = 0, up_mps = 0, along_mps2 = 0, up_mps2 = 0;
    };
    virtual Motion motion_at(double, double y_m, double) const { return {.depth_m = -y_m}; }

    double along_x_ = 1, along_z_ = 0;
};

/// A regular wave, a cos(k s - omega t), by Airy's theory with Wheeler's stretching in deep water.
class RegularWave : public StillWater {
   public:
    explicit RegularWave(double heading_rad = 0) {
        along_x_ = std::cos(heading_rad);
        along_z_ = std::sin(heading_rad);
    }
    void set_wave(double amplitude_m, double k, double time_s) {
        amplitude_m_ = amplitude_m;
        k_ = k;
        at_s_ = time_s_ = time_s;
    }

   private:
    Motion motion_at(double x_m, double y_m, double z_m) const override {
        const double omega = std::sqrt(gravity_mps2 * k_);
        const double phase = k_ * (along_x_ * x_m + along_z_ * z_m) - omega * at_s_;
        const double height_m = amplitude_m_ * std::cos(phase), depth_m = height_m - y_m;
        const double left = amplitude_m_ * std::exp(-k_ * std::max(depth_m, 0.0));
        const double cosine = left * std::cos(phase), sine = left * std::sin(phase), omega2 = omega * omega;
        return {depth_m, cosine, omega * cosine, omega * sine, omega2 * sine, -omega2 * cosine};
    }

    double amplitude_m_ = 0, k_ = 1, at_s_ = 0;
};

}  // namespace pelagic
