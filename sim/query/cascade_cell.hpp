// A cell of a cascade in double precision, for scalar searches.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "pelagic/sim/buffers/surface_texels.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic {

/// Weights of the Catmull-Rom cubic and their derivatives, at t in [0, 1] from the second to the
/// third of four texels (CubicWeights of kernels/surface_query.kernel.hpp).
struct CubicWeightsInDouble {
    std::array<double, 4> value, slope;

    explicit CubicWeightsInDouble(double t)
        : value{0.5 * t * (t * (2 - t) - 1), 1 + 0.5 * t * t * (3 * t - 5), 0.5 * t * (1 + t * (4 - 3 * t)),
                0.5 * t * t * (t - 1)},
          slope{0.5 * (t * (4 - 3 * t) - 1), 0.5 * t * (9 * t - 10), 0.5 * (1 + t * (8 - 9 * t)),
                0.5 * t * (3 * t - 2)} {}
};

/// Upper bounds of the interpolated value divided by the largest of its 16 texels, and of the slope
/// divided by the largest difference between texels. Along an axis the absolute weights sum to at
/// most 5/4, and those of the slope to at most 3/2.
inline constexpr double max_cubic_value = 25.0 / 16, max_cubic_slope = 15.0 / 8;

class CascadeCell {
   public:
    struct Value {
        double value, along_u, along_v;  ///< derivatives along the cascade's axes, per texel
    };

    CascadeCell(const SurfaceTexels& texels, int i, int j, Interpolation interpolation)
        : interpolation_(interpolation) {
        const int first = interpolation == Interpolation::cubic ? -1 : 0, side = 2 - 2 * first;
        for (int b = 0; b < side; ++b)
            for (int a = 0; a < side; ++a)
                places_[static_cast<std::size_t>(b * side + a)] = place_of(texels, i + first + a, j + first + b);
    }

    Value at(const float* plane, double u, double v) const {
        return interpolation_ == Interpolation::cubic ? cubic(plane, u, v) : bilinear(plane, u, v);
    }

    struct Range {
        double min, max;
    };
    /// Returns bounds of a cubic cell's values.
    Range range(const float* plane) const {
        Range texels{plane[places_[0]], plane[places_[0]]};
        for (const std::ptrdiff_t place : places_) {
            texels.min = std::min(texels.min, static_cast<double>(plane[place]));
            texels.max = std::max(texels.max, static_cast<double>(plane[place]));
        }
        const double beyond = (max_cubic_value - 1) / 2 * (texels.max - texels.min);
        return {texels.min - beyond, texels.max + beyond};
    }

   private:
    Value bilinear(const float* plane, double u, double v) const {
        const double a = plane[places_[0]], b = plane[places_[1]], c = plane[places_[2]], d = plane[places_[3]];
        const double low = a + u * (b - a), high = c + u * (d - c);
        return {low + v * (high - low), (b - a) + v * ((d - c) - (b - a)), high - low};
    }
    Value cubic(const float* plane, double u, double v) const {
        const CubicWeightsInDouble along(u), across(v);
        Value sum{};
        for (std::size_t row = 0; row < 4; ++row) {
            double value = 0, slope = 0;
            for (std::size_t column = 0; column < 4; ++column) {
                const double texel = plane[places_[4 * row + column]];
                value += along.value[column] * texel;
                slope += along.slope[column] * texel;
            }
            sum.value += across.value[row] * value;
            sum.along_u += across.value[row] * slope;
            sum.along_v += across.slope[row] * value;
        }
        return sum;
    }

    Interpolation interpolation_;
    std::array<std::ptrdiff_t, 16> places_;
};

}  // namespace pelagic
