#include "pelagic/tests/oracle/stack_oracle.hpp"

#include <algorithm>
#include <cmath>

namespace pelagic::oracle {
namespace {

// In units of the finest texel: below this size, squares are searched with Newton's method.
constexpr double smallest_square_texels = 1.0 / 16;

// Above this number of cells along an axis, the range of the whole plane is used.
constexpr double max_cells = 6;

std::vector<double> plane_of(const PlaneView& view) {
    std::vector<double> plane;
    for (int j = 0; view.data && j < view.resolution; ++j)
        for (int i = 0; i < view.resolution; ++i) plane.push_back(static_cast<double>(view.at(i, j)));
    return plane;
}

}  // namespace

Stack::Stack(const Frame& frame, Interpolation interpolation) {
    for (const Cascade& cascade : frame.cascades) {
        Layer layer{.n = cascade.resolution(),
                    .texel_m = cascade.grid.side_m / cascade.resolution(),
                    .cosine = cascade.grid.cosine,
                    .sine = cascade.grid.sine,
                    .dx = plane_of(cascade.dx),
                    .height = plane_of(cascade.height),
                    .dz = plane_of(cascade.dz),
                    .velocity_x = plane_of(cascade.velocity_x),
                    .velocity_y = plane_of(cascade.velocity_y),
                    .velocity_z = plane_of(cascade.velocity_z),
                    .dx_range = {},
                    .dz_range = {},
                    .interpolation = interpolation};
        const auto range_of = [&](const std::vector<double>& plane) {
            const auto [min, max] = std::minmax_element(plane.begin(), plane.end());
            // Four weights whose sum is 1 are at worst -1/16, 9/16, 9/16, -1/16 along either axis.
            const double beyond = interpolation == Interpolation::cubic ? (1.25 * 1.25 - 1) / 2 * (*max - *min) : 0;
            reach_m_ += std::max(-*min, *max) + beyond;
            return Range{*min - beyond, *max + beyond};
        };
        layer.dx_range = range_of(layer.dx);
        layer.dz_range = range_of(layer.dz);
        layers_.push_back(std::move(layer));
    }
}

double Stack::Layer::at(const std::vector<double>& plane, int i, int j) const {
    return plane[static_cast<std::size_t>(((j % n + n) % n) * n + (i % n + n) % n)];
}

double Stack::Layer::value(const std::vector<double>& plane, double u, double v) const {
    if (interpolation == Interpolation::cubic) return cubic_value(plane, u, v);
    const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
    u -= i;
    v -= j;
    return (1 - v) * ((1 - u) * at(plane, i, j) + u * at(plane, i + 1, j)) +
           v * ((1 - u) * at(plane, i, j + 1) + u * at(plane, i + 1, j + 1));
}

// Hermite's cubic of two values and their central differences, along one axis and then along the
// other.
double Stack::Layer::cubic_value(const std::vector<double>& plane, double u, double v) const {
    const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
    const auto hermite = [](double before, double left, double right, double behind, double t) {
        const double left_slope = (right - before) / 2, right_slope = (behind - left) / 2;
        const double t2 = t * t, t3 = t2 * t;
        return (2 * t3 - 3 * t2 + 1) * left + (t3 - 2 * t2 + t) * left_slope + (3 * t2 - 2 * t3) * right +
               (t3 - t2) * right_slope;
    };
    const auto row = [&](int b) {
        return hermite(at(plane, i - 1, b), at(plane, i, b), at(plane, i + 1, b), at(plane, i + 2, b), u - i);
    };
    return hermite(row(j - 1), row(j), row(j + 1), row(j + 2), v - j);
}

double Stack::Layer::slope(const std::vector<double>& plane, double u, double v, bool is_across) const {
    if (interpolation == Interpolation::cubic) {
        const double small = 1e-5, a = is_across ? 0 : small, b = is_across ? small : 0;
        return (value(plane, u + a, v + b) - value(plane, u - a, v - b)) / (2 * small * texel_m);
    }
    const int i = static_cast<int>(std::floor(u)), j = static_cast<int>(std::floor(v));
    const auto central = [&](int a, int b) {
        return is_across ? (at(plane, a, b + 1) - at(plane, a, b - 1)) / (2 * texel_m)
                         : (at(plane, a + 1, b) - at(plane, a - 1, b)) / (2 * texel_m);
    };
    u -= i;
    v -= j;
    return (1 - v) * ((1 - u) * central(i, j) + u * central(i + 1, j)) +
           v * ((1 - u) * central(i, j + 1) + u * central(i + 1, j + 1));
}

// A bilinear patch has its extremes at its corners, so values at the intersections of the square's
// sides and the texel lines bound it.
Stack::Range Stack::Layer::range(const std::vector<double>& plane, Range all, double u, double v,
                                 double reach) const {
    if (2 * reach > max_cells) return all;
    if (interpolation == Interpolation::cubic) {
        // The slope along an axis is a sum of texel differences with weights of at most 1.5 * 1.25.
        const int first_i = static_cast<int>(std::floor(u - reach)) - 1,
                  last_i = static_cast<int>(std::floor(u + reach)) + 2;
        const int first_j = static_cast<int>(std::floor(v - reach)) - 1,
                  last_j = static_cast<int>(std::floor(v + reach)) + 2;
        double along = 0, across = 0;
        for (int j = first_j; j <= last_j; ++j)
            for (int i = first_i; i <= last_i; ++i) {
                if (i < last_i) along = std::max(along, std::fabs(at(plane, i + 1, j) - at(plane, i, j)));
                if (j < last_j) across = std::max(across, std::fabs(at(plane, i, j + 1) - at(plane, i, j)));
            }
        const double here = value(plane, u, v), change = 1.5 * 1.25 * (along + across) * reach;
        return {std::max(all.min, here - change), std::min(all.max, here + change)};
    }
    Range found{1e300, -1e300};
    const auto next = [&](double place, double end) {
        return place >= end ? end + 1 : std::min(end, std::floor(place) + 1);
    };
    for (double b = v - reach; b <= v + reach; b = next(b, v + reach)) {
        for (double a = u - reach; a <= u + reach; a = next(a, u + reach)) {
            const double here = value(plane, a, b);
            found = {std::min(found.min, here), std::max(found.max, here)};
        }
    }
    return found;
}

Stack::Vector Stack::sum(double x_m, double z_m, const std::vector<double> Layer::*x,
                         const std::vector<double> Layer::*y, const std::vector<double> Layer::*z) const {
    Vector all{0, 0, 0};
    for (const Layer& layer : layers_) {
        const double u = layer.along(x_m, z_m), v = layer.across(x_m, z_m);
        all.x += layer.value(layer.*x, u, v);
        all.y += layer.value(layer.*y, u, v);
        all.z += layer.value(layer.*z, u, v);
    }
    return all;
}

Stack::Vector Stack::displacement_at(double x_m, double z_m) const {
    return sum(x_m, z_m, &Layer::dx, &Layer::height, &Layer::dz);
}

Stack::Vector Stack::velocity_at(double x_m, double z_m) const {
    return sum(x_m, z_m, &Layer::velocity_x, &Layer::velocity_y, &Layer::velocity_z);
}

SurfaceFacts Stack::facts_at(double x_m, double z_m) const {
    double slopes[3][2] = {};
    for (const Layer& layer : layers_) {
        const double u = layer.along(x_m, z_m), v = layer.across(x_m, z_m);
        const std::vector<double>* const planes[3] = {&layer.dx, &layer.height, &layer.dz};
        for (int p = 0; p < 3; ++p) {
            const double along = layer.slope(*planes[p], u, v, false), across = layer.slope(*planes[p], u, v, true);
            slopes[p][0] += layer.cosine * along - layer.sine * across;
            slopes[p][1] += layer.sine * along + layer.cosine * across;
        }
    }
    // Tangents (1 + Dx,x, h,x, Dz,x) and (Dx,z, h,z, 1 + Dz,z); the cross product of the second and
    // the first points up.
    const double x = slopes[1][1] * slopes[2][0] - (1 + slopes[2][1]) * slopes[1][0];
    const double y = (1 + slopes[2][1]) * (1 + slopes[0][0]) - slopes[0][1] * slopes[2][0];
    const double z = slopes[0][1] * slopes[1][0] - slopes[1][1] * (1 + slopes[0][0]);
    const double length = std::sqrt(x * x + y * y + z * z);
    return {x / length, y / length, z / length, y};
}

std::vector<StackIntersection> Stack::intersections_at(double x_m, double z_m) const {
    std::vector<StackIntersection> intersections;
    search(x_m, z_m, x_m, z_m, reach_m_, intersections);
    std::sort(intersections.begin(), intersections.end(),
              [](const StackIntersection& a, const StackIntersection& b) { return a.height_m > b.height_m; });
    return intersections;
}

// Searches the square of reference points from (x - half, z - half) to (x + half, z + half).
void Stack::search(double point_x, double point_z, double x, double z, double half,
                   std::vector<StackIntersection>& intersections) const {
    Range drawn_x{x - half, x + half}, drawn_z{z - half, z + half};
    for (const Layer& layer : layers_) {
        const double u = layer.along(x, z), v = layer.across(x, z);
        const double reach = half / layer.texel_m * (std::fabs(layer.cosine) + std::fabs(layer.sine));
        const Range dx = layer.range(layer.dx, layer.dx_range, u, v, reach);
        const Range dz = layer.range(layer.dz, layer.dz_range, u, v, reach);
        drawn_x = {drawn_x.min + dx.min, drawn_x.max + dx.max};
        drawn_z = {drawn_z.min + dz.min, drawn_z.max + dz.max};
    }
    const auto is_off = [](double p, Range range) { return p < range.min - 1e-9 || p > range.max + 1e-9; };
    if (is_off(point_x, drawn_x) || is_off(point_z, drawn_z)) return;
    if (half <= layers_.back().texel_m * smallest_square_texels)
        return refine(point_x, point_z, x, z, half, intersections);
    const double quarter = half / 2;
    for (const double to_x : {-quarter, quarter})
        for (const double to_z : {-quarter, quarter})
            search(point_x, point_z, x + to_x, z + to_z, quarter, intersections);
}

// Newton's method with numeric derivatives.
void Stack::refine(double point_x, double point_z, double x, double z, double half,
                   std::vector<StackIntersection>& intersections) const {
    const double begin_x = x, begin_z = z;
    const auto off = [&](double at_x, double at_z) {
        const Vector d = displacement_at(at_x, at_z);
        return Vector{at_x + d.x - point_x, d.y, at_z + d.z - point_z};
    };
    for (int step = 0; step < 40; ++step) {
        const Vector here = off(x, z);
        if (std::hypot(here.x, here.z) < 1e-11) break;
        const double small = 1e-7;
        const Vector right = off(x + small, z), left = off(x - small, z), below = off(x, z + small),
                     above = off(x, z - small);
        const double xx = (right.x - left.x) / (2 * small), zx = (right.z - left.z) / (2 * small);
        const double xz = (below.x - above.x) / (2 * small), zz = (below.z - above.z) / (2 * small);
        const double determinant = xx * zz - xz * zx;
        if (determinant == 0) return;
        x -= (zz * here.x - xz * here.z) / determinant;
        z -= (xx * here.z - zx * here.x) / determinant;
        if (!(std::fabs(x - begin_x) < 4 * half && std::fabs(z - begin_z) < 4 * half)) return;
    }
    const Vector here = off(x, z);
    if (std::hypot(here.x, here.z) > 1e-9) return;
    // already found from the neighbouring square
    for (const StackIntersection& intersection : intersections)
        if (std::fabs(intersection.x_m - x) < 1e-6 && std::fabs(intersection.z_m - z) < 1e-6) return;
    intersections.push_back({x, z, here.y});
}

}  // namespace pelagic::oracle
