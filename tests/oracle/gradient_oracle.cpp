#include "pelagic/tests/oracle/gradient_oracle.hpp"

#include <algorithm>
#include <cmath>

namespace pelagic::oracle {
namespace {

/// Central differences with periodic wrap, equations 45 and 46.
struct Slopes {
    double x, z;
};
Slopes slopes_at(const Plane& plane, int n, int i, int j, double patch_size_m) {
    const auto at = [&](int a, int b) { return plane[static_cast<std::size_t>((b + n) % n * n + (a + n) % n)]; };
    const double per_metre = n / patch_size_m / 2;
    return {(at(i + 1, j) - at(i - 1, j)) * per_metre, (at(i, j + 1) - at(i, j - 1)) * per_metre};
}

double length_of(const std::array<double, 3>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

double smoothness_of_length(double length) {
    const double t = std::clamp((length - 2.0 / 3) / (1.0 / 3), 0.0, 1.0);
    return 1 - std::sqrt(1 - t * (0.85 + 0.15 * t));
}

Level base_level(const Displacement& surface, double patch_size_m, double roughness) {
    const int n = surface.n;
    const double r = roughness;
    const double length = 1 - r * (0.306 + r * (0.113 - r * 0.081));
    Level level{n, {}, {}, Plane(static_cast<std::size_t>(n) * n, 1 - std::sqrt(r))};
    for (int j = 0; j < n; ++j) {
        for (int i = 0; i < n; ++i) {
            const Slopes dx = slopes_at(surface.dx, n, i, j, patch_size_m);
            const Slopes h = slopes_at(surface.height, n, i, j, patch_size_m);
            const Slopes dz = slopes_at(surface.dz, n, i, j, patch_size_m);
            // The tangents of the displaced point along x and z; their cross product points up.
            const std::array<double, 3> along_x = {1 + dx.x, h.x, dz.x}, along_z = {dx.z, h.z, 1 + dz.z};
            std::array<double, 3> normal = {along_z[1] * along_x[2] - along_z[2] * along_x[1],
                                            along_z[2] * along_x[0] - along_z[0] * along_x[2],
                                            along_z[0] * along_x[1] - along_z[1] * along_x[0]};
            const double size = length_of(normal);
            level.jacobian.push_back(std::clamp(normal[1], -1.0, 1.0));
            for (double& part : normal) part *= length / size;
            level.normal.push_back(normal);
        }
    }
    return level;
}

Level halved(const Level& finer) {
    Level level{finer.side / 2, {}, {}, {}};
    for (int j = 0; j < level.side; ++j) {
        for (int i = 0; i < level.side; ++i) {
            std::array<double, 3> normal{};
            double jacobian = 0;
            for (const int texel : {2 * j * finer.side + 2 * i, 2 * j * finer.side + 2 * i + 1,
                                    (2 * j + 1) * finer.side + 2 * i, (2 * j + 1) * finer.side + 2 * i + 1}) {
                for (std::size_t c = 0; c < 3; ++c) normal[c] += finer.normal[static_cast<std::size_t>(texel)][c] / 4;
                jacobian += finer.jacobian[static_cast<std::size_t>(texel)] / 4;
            }
            level.normal.push_back(normal);
            level.jacobian.push_back(jacobian);
            level.smoothness.push_back(smoothness_of_length(length_of(normal)));
        }
    }
    return level;
}

}  // namespace

Displacement displacement_of(const Frame& frame) {
    Displacement surface{frame.cascades[0].resolution(), {}, {}, {}};
    for (int j = 0; j < frame.cascades[0].resolution(); ++j) {
        for (int i = 0; i < frame.cascades[0].resolution(); ++i) {
            surface.dx.push_back(frame.cascades[0].dx.at(i, j));
            surface.height.push_back(frame.cascades[0].height.at(i, j));
            surface.dz.push_back(frame.cascades[0].dz.at(i, j));
        }
    }
    return surface;
}

Plane jacobian_of(const Displacement& surface, double patch_size_m) {
    Plane jacobian;
    for (int j = 0; j < surface.n; ++j) {
        for (int i = 0; i < surface.n; ++i) {
            const Slopes dx = slopes_at(surface.dx, surface.n, i, j, patch_size_m);
            const Slopes dz = slopes_at(surface.dz, surface.n, i, j, patch_size_m);
            jacobian.push_back((1 + dx.x) * (1 + dz.z) - dx.z * dz.x);
        }
    }
    return jacobian;
}

std::vector<Level> levels_of(const Displacement& surface, double patch_size_m, double roughness) {
    std::vector<Level> levels = {base_level(surface, patch_size_m, roughness)};
    while (levels.back().side > 1) levels.push_back(halved(levels.back()));
    return levels;
}

std::array<double, 4> bytes_of(const Level& level, std::size_t texel) {
    const std::array<double, 3>& normal = level.normal[texel];
    const double length = length_of(normal);
    return {(normal[0] / length * 0.5 + 0.5) * 255, (normal[2] / length * 0.5 + 0.5) * 255,
            (level.jacobian[texel] * 0.5 + 0.5) * 255, level.smoothness[texel] * 255};
}

}  // namespace pelagic::oracle
