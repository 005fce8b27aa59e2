// Angle and wavelength of a wake.
#pragma once

#include <array>
#include <cmath>
#include <numbers>
#include <vector>

namespace pelagic {

struct KelvinWake {
    /// Of the waves along the centre line; 0 with fewer than four of them.
    double length_m = 0;
    std::array<double, 2> angle_rad = {};  ///< of the edge, to each side
};

/// The distance of a wake's highest waves from its edge, inwards, at a distance `behind` in metres.
/// Near the edge the phase is cubic across the wake, so heights follow Airy's function, whose first
/// maximum is at -1.01879. With k = g / v^2, the edge's waves at tan = 1/sqrt 2, and the phase
/// k (x + y tan) / cos (Kelvin 1887; Ursell 1960), the third derivative of the phase there is
/// 2 k x / sqrt 3. The derivative of its slope in y is k sqrt(8/3).
inline double crest_inside_of_edge(double behind, double k) {
    return 1.01879 * std::cbrt(k * behind / std::sqrt(3.0)) / (k * std::sqrt(8.0 / 3));
}

/// Returns the slope of the least-squares line y = slope x + offset.
inline double fitted_slope(const std::vector<double>& x, const std::vector<double>& y) {
    double sx = 0, sy = 0, sxx = 0, sxy = 0;
    const double n = static_cast<double>(x.size());
    for (std::size_t i = 0; i < x.size(); ++i) sx += x[i], sy += y[i], sxx += x[i] * x[i], sxy += x[i] * y[i];
    return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

/// Measures a wake.
/// \param height       height(behind, aside), metres, of positions relative to the boat
/// \param length_m     expected wavelength, 2 pi v^2 / g
/// \param first, last  wavelengths behind the boat between which its edge is measured
template <class Height>
KelvinWake measure_wake(const Height& height, double length_m, double texel_m, double first, double last) {
    KelvinWake wake;
    // Along the centre line, where waves travel at the boat's speed: the mean distance of upward
    // zero crossings.
    std::vector<double> rises;
    for (double at = 2 * length_m; at < 6 * length_m; at += texel_m) {
        const double here = height(at, 0), next = height(at + texel_m, 0);
        if (here < 0 && next >= 0) rises.push_back(at + texel_m * here / (here - next));
    }
    if (rises.size() >= 4) wake.length_m = (rises.back() - rises.front()) / static_cast<double>(rises.size() - 1);
    for (std::size_t side = 0; side < 2; ++side) {
        std::vector<double> places, edges;
        for (double behind = first * length_m; behind <= last * length_m; behind += length_m / 4) {
            // The position of the largest heights over one wavelength: smoothed over five texels,
            // outside of the waves along the centre line.
            double largest = 0, edge = 0;
            for (double aside = 0.2 * behind; aside < 0.6 * behind; aside += texel_m) {
                double sum = 0;
                for (int across = -2; across <= 2; ++across)
                    for (double along = -length_m / 2; along < length_m / 2; along += texel_m) {
                        const double h = height(behind + along, (side == 0 ? -1 : 1) * (aside + across * texel_m));
                        sum += h * h;
                    }
                if (sum <= largest) continue;
                largest = sum;
                edge = aside;
            }
            places.push_back(behind);
            edges.push_back(edge + crest_inside_of_edge(behind, 2 * std::numbers::pi / length_m));
        }
        wake.angle_rad[side] = std::atan(fitted_slope(places, edges));
    }
    return wake;
}

}  // namespace pelagic
