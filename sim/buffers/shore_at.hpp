// Interpolation of a shore at one position. It computes the fields of sample() in shore.hpp one by
// one, so that a query computes only the fields that it writes.
//
// Fields of the waves are interpolated cubically, fields of the floor bilinearly. In one dimension
// the cubic convolution of Keys (1981), of the four texels around a position, keeps at least 0.991
// of the amplitude of a wave of 8 texels. Bilinear interpolation keeps cos(pi / 8) = 0.924. The
// derivative of that cubic is 0.90 to 1.05 of the wave's derivative; normals use it, because they
// must match the heights. Velocities use six texels: the derivative of the cubic through the two
// nearest texels, whose slopes are fourth-order differences. It is 0.988 to 1.005 of the wave's
// derivative.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "pelagic/sim/shore_surface.hpp"

namespace pelagic {

class ShoreAt {
   public:
    /// \pre the shore is not empty
    ShoreAt(const ShoreSurface& shore, double x_m, double z_m) : shore_(shore) {
        const double u = (x_m - shore.x_m) / shore.texel_m, v = (z_m - shore.z_m) / shore.texel_m;
        is_place_ = u == u && v == v;
        is_within_ = u >= 0 && v >= 0 && u < shore.columns - 1 && v < shore.rows - 1;
        if (!is_place_) return;
        const double near_u = std::clamp(u, 0.0, shore.columns - 1.0), near_v = std::clamp(v, 0.0, shore.rows - 1.0);
        i_ = std::min(static_cast<int>(near_u), shore.columns - 2);
        j_ = std::min(static_cast<int>(near_v), shore.rows - 2);
        right_ = near_u - i_;
        down_ = near_v - j_;
    }

    bool is_place() const { return is_place_; }    ///< false if x or z is not a number
    bool is_within() const { return is_within_; }  ///< false outside the rectangle

    /// Interpolates `texel(index)` bilinearly. Positions outside the rectangle are clamped to its
    /// edge.
    /// \pre is_place()
    template <class Texel>
    double linear(const Texel& texel) const {
        const std::size_t row = texel_index(i_, j_), below = row + static_cast<std::size_t>(shore_.columns);
        const double upper = texel(row) + right_ * (texel(row + 1) - texel(row));
        const double lower = texel(below) + right_ * (texel(below + 1) - texel(below));
        return upper + down_ * (lower - upper);
    }

    /// Returns the weight of a cascade, in [0, 1]. \pre is_place()
    double weight(std::size_t cascade) const {
        return linear([this, cascade](std::size_t texel) {
            return static_cast<double>(shore_.weights_rgba8[texel] >> 8 * cascade & 255) * (1.0 / 255);
        });
    }

    /// Returns the foam, in [0, 1]. \pre is_within()
    double foam() const {
        return linear([this](std::size_t texel) { return static_cast<double>(shore_.foam[texel]) * (1.0 / 255); });
    }

    struct Cubic {
        double value = 0, along_x = 0, along_z = 0;  ///< derivatives per metre
    };
    /// Interpolates a plane cubically (Keys 1981); zeros outside the rectangle.
    Cubic cubic(std::span<const float> plane) const {
        if (!is_within_) return {};
        return between<4>(plane, keys(right_), keys(down_));
    }
    /// Returns the gradient of ShoreSurface::potential_m2ps, m/s; zeros outside the rectangle.
    std::array<double, 2> velocity() const {
        if (!is_within_) return {};
        const Cubic at = between<6>(shore_.potential_m2ps, fourth_order(right_), fourth_order(down_));
        return {at.along_x, at.along_z};
    }

   private:
    /// Weights of `count` texels, of which the first is at offset 1 - count / 2.
    template <std::size_t count>
    struct Weights {
        std::array<double, count> value, derivative;
    };

    static Weights<4> keys(double t) {
        return {{0.5 * t * (t * (2 - t) - 1), 0.5 * (t * t * (3 * t - 5) + 2), 0.5 * t * (t * (4 - 3 * t) + 1),
                 0.5 * t * t * (t - 1)},
                {0.5 * (t * (4 - 3 * t) - 1), 0.5 * t * (9 * t - 10), 0.5 * (t * (8 - 9 * t) + 1),
                 0.5 * t * (3 * t - 2)}};
    }
    static Weights<6> fourth_order(double t) {
        const auto weights = [](double here, double next, double slope, double next_slope) {
            constexpr double near = 8.0 / 12, far = 1.0 / 12;
            return std::array{far * slope,         far * next_slope - near * slope, here - near * next_slope,
                              next + near * slope, near * next_slope - far * slope, 0 - far * next_slope};
        };
        return {weights(1 - t * t * (3 - 2 * t), t * t * (3 - 2 * t), t * (1 - t) * (1 - t), t * t * (t - 1)),
                weights(6 * t * (t - 1), 6 * t * (1 - t), 1 - t * (4 - 3 * t), t * (3 * t - 2))};
    }

    std::size_t texel_index(int i, int j) const {
        return static_cast<std::size_t>(j) * static_cast<std::size_t>(shore_.columns) + static_cast<std::size_t>(i);
    }

    /// Texel indices are clamped to the rectangle.
    template <std::size_t count>
    Cubic between(std::span<const float> plane, const Weights<count>& along, const Weights<count>& across) const {
        constexpr int first = 1 - static_cast<int>(count) / 2;
        std::array<std::size_t, count> columns;
        for (std::size_t n = 0; n < count; ++n)
            columns[n] =
                static_cast<std::size_t>(std::clamp(i_ + first + static_cast<int>(n), 0, shore_.columns - 1));
        Cubic sum;
        for (std::size_t m = 0; m < count; ++m) {
            const float* const row =
                plane.data() + texel_index(0, std::clamp(j_ + first + static_cast<int>(m), 0, shore_.rows - 1));
            double value = 0, derivative = 0;
            for (std::size_t n = 0; n < count; ++n) {
                value += along.value[n] * static_cast<double>(row[columns[n]]);
                derivative += along.derivative[n] * static_cast<double>(row[columns[n]]);
            }
            sum.value += across.value[m] * value;
            sum.along_x += across.value[m] * derivative;
            sum.along_z += across.derivative[m] * value;
        }
        sum.along_x /= shore_.texel_m;
        sum.along_z /= shore_.texel_m;
        return sum;
    }

    const ShoreSurface& shore_;
    bool is_place_, is_within_;
    int i_ = 0, j_ = 0;
    double right_ = 0, down_ = 0;
};

}  // namespace pelagic
