// Angles of directions from + - * / and square roots, bit-identical on every machine.
#pragma once

#include <cmath>
#include <numbers>

namespace pelagic {

/// Returns the angle of (x, y) from +x towards +y, in [-pi, pi]; 0 for (0, 0). The tangent is halved three
/// times, and nine terms of the series remain: the error is at most 4e-16 of the angle and 4e-16 of pi.
inline double angle_of(double x, double y) {
    constexpr double pi = std::numbers::pi;
    const double across = std::fabs(x), up = std::fabs(y);
    if (across == 0 && up == 0) return 0;
    const bool is_steep = up > across;
    double tangent = is_steep ? across / up : up / across;
    for (int i = 0; i < 3; ++i) tangent /= 1 + std::sqrt(1 + tangent * tangent);
    double series = 0;
    for (int n = 17; n >= 1; n -= 2) series = 1.0 / n - tangent * tangent * series;
    double angle = 8 * tangent * series;
    if (is_steep) angle = pi / 2 - angle;
    if (x < 0) angle = pi - angle;
    return y < 0 ? -angle : angle;
}

}  // namespace pelagic
