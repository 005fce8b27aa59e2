// Seams of the engine's round meshes, which end at the angle 2 pi, whose sine is not 0.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <vector>

namespace pelagic::godot {

/// Moves vertices that are apart by rounding to one position. Leaves vertices that are not finite, which the reader of
/// the mesh reports. \tparam Vector  has the members x, y and z
template <class Vector>
void close_seams(std::vector<Vector>& vertices_m) {
    double size_m = 0;
    for (const Vector& v : vertices_m) size_m = std::max({size_m, std::fabs(v.x), std::fabs(v.y), std::fabs(v.z)});
    const auto is_finite = [](const Vector& v) { return std::isfinite(v.x + v.y + v.z); };
    if (!std::all_of(vertices_m.begin(), vertices_m.end(), is_finite)) return;
    const double near_m = 1e-6 * size_m;
    std::vector<std::size_t> order(vertices_m.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return vertices_m[a].x < vertices_m[b].x; });
    std::vector<bool> is_placed(order.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
        if (is_placed[order[i]]) continue;
        const Vector at = vertices_m[order[i]];
        for (std::size_t j = i + 1; j < order.size() && vertices_m[order[j]].x - at.x <= near_m; ++j) {
            Vector& other = vertices_m[order[j]];
            if (std::fabs(other.y - at.y) > near_m || std::fabs(other.z - at.z) > near_m) continue;
            is_placed[order[j]] = true;
            other = at;
        }
    }
}

}  // namespace pelagic::godot
