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
    /// Planes that are read at one position.
    template <std::size_t Planes>
    using Planar = std::array<const float*, Planes>;

    CascadeCell(const SurfaceTexels& texels, int i, int j, Interpolation interpolation)
        : interpolation_(interpolation) {
        const int first = interpolation == Interpolation::cubic ? -1 : 0;
        for (int a = 0; a < 2 - 2 * first; ++a) {
            columns_[static_cast<std::size_t>(a)] = texel_offset(texels, i + first + a, 0);
            rows_[static_cast<std::size_t>(a)] = texel_offset(texels, 0, j + first + a);
        }
    }

    Value at(const float* plane, double u, double v) const { return at(Planar<1>{plane}, u, v)[0]; }

    template <std::size_t Planes>
    std::array<Value, Planes> at(const Planar<Planes>& planes, double u, double v) const {
        std::array<Value, Planes> values{};
        if (interpolation_ == Interpolation::linear) {
            for (std::size_t p = 0; p < Planes; ++p) values[p] = bilinear(planes[p], u, v);
            return values;
        }
        const CubicWeightsInDouble along(u), across(v);
        for (std::size_t row = 0; row < 4; ++row) {
            std::array<double, Planes> value{}, slope{};
            for (std::size_t column = 0; column < 4; ++column)
                for (std::size_t p = 0; p < Planes; ++p) {
                    const double texel = texel_of(planes[p], column, row);
                    value[p] += along.value[column] * texel;
                    slope[p] += along.slope[column] * texel;
                }
            for (std::size_t p = 0; p < Planes; ++p) {
                values[p].value += across.value[row] * value[p];
                values[p].along_u += across.value[row] * slope[p];
                values[p].along_v += across.slope[row] * value[p];
            }
        }
        return values;
    }

    /// Returns the values of at() without derivatives.
    template <std::size_t Planes>
    std::array<double, Planes> values_at(const Planar<Planes>& planes, double u, double v) const {
        std::array<double, Planes> values{};
        if (interpolation_ == Interpolation::linear) {
            for (std::size_t p = 0; p < Planes; ++p) values[p] = bilinear(planes[p], u, v).value;
            return values;
        }
        const CubicWeightsInDouble along(u), across(v);
        for (std::size_t row = 0; row < 4; ++row) {
            std::array<double, Planes> value{};
            for (std::size_t column = 0; column < 4; ++column)
                for (std::size_t p = 0; p < Planes; ++p)
                    value[p] += along.value[column] * texel_of(planes[p], column, row);
            for (std::size_t p = 0; p < Planes; ++p) values[p] += across.value[row] * value[p];
        }
        return values;
    }

    struct Range {
        double min, max;
    };
    /// Returns bounds of a cubic cell's values.
    Range range(const float* plane) const {
        Range texels{texel_of(plane, 0, 0), texel_of(plane, 0, 0)};
        for (std::size_t row = 0; row < 4; ++row)
            for (std::size_t column = 0; column < 4; ++column) {
                texels.min = std::min(texels.min, texel_of(plane, column, row));
                texels.max = std::max(texels.max, texel_of(plane, column, row));
            }
        const double beyond = (max_cubic_value - 1) / 2 * (texels.max - texels.min);
        return {texels.min - beyond, texels.max + beyond};
    }

   private:
    double texel_of(const float* plane, std::size_t column, std::size_t row) const {
        return plane[rows_[row] + columns_[column]];
    }
    Value bilinear(const float* plane, double u, double v) const {
        const double a = texel_of(plane, 0, 0), b = texel_of(plane, 1, 0), c = texel_of(plane, 0, 1),
                     d = texel_of(plane, 1, 1);
        const double low = a + u * (b - a), high = c + u * (d - c);
        return {low + v * (high - low), (b - a) + v * ((d - c) - (b - a)), high - low};
    }

    Interpolation interpolation_;
    std::array<std::ptrdiff_t, 4> columns_, rows_;  ///< offsets; two each of a linear cell
};

}  // namespace pelagic
