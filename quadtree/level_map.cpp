#include "pelagic/quadtree/level_map.hpp"

#include <algorithm>
#include <cassert>
#include <cmath>

#include "pelagic/message/require.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr auto zone = static_cast<float>(LevelMap::morph_zone);

/// Returns the squared radius, in units of (tau s)^2, within which a node affects coarser levels.
/// Each level adds k to its demand, so at level l a node with a measure of -l k or less causes no
/// split.
double reach_squared(int level) { return 1 + LevelMap::morph_zone * level; }

/// Clamps before the conversion, because the viewer may be very far away.
std::int32_t to_cell(double x, std::int32_t cells) {
    return static_cast<std::int32_t>(std::floor(std::clamp(x, 0.0, static_cast<double>(cells))));
}

}  // namespace

LevelMap::LevelMap(const QuadtreeOptions& options)
    : size_m_(checked(options).size_m),
      lod_scale_(options.lod_scale),
      deepest_(pelagic::deepest_level(options.size_m, options.finest_patch_m)),
      windows_(static_cast<std::size_t>(deepest_)) {
    const DefaultFloatEnvironment environment;
    // Allocates the largest window of each level: its own disc and the parents that the finer level
    // demands.
    std::int32_t side = 0;
    for (int level = deepest_ - 1; level >= 0; --level) {
        const auto disc = static_cast<std::int32_t>(2 * lod_scale_ * std::sqrt(reach_squared(level))) + 4;
        side = std::min(std::max(disc, side / 2 + 3) + 2, std::int32_t{1} << level);
        windows_[static_cast<std::size_t>(level)].measures.resize(static_cast<std::size_t>(side) *
                                                                  static_cast<std::size_t>(side));
    }
}

std::size_t LevelMap::max_patches() const {
    std::size_t splits = 0;
    for (const Window& window : windows_) splits += window.measures.size();
    return 1 + 3 * splits;  // each split replaces one patch by four
}

void LevelMap::update(const glm::dvec3& viewer_m) {
    for (int level = deepest_ - 1; level >= 0; --level) {
        open_window(level, viewer_m);
        if (level + 1 < deepest_) demand_of_parents(level + 1);
    }
}

void LevelMap::open_window(int level, const glm::dvec3& viewer_m) {
    Window& w = windows_[static_cast<std::size_t>(level)];
    const std::int32_t cells = std::int32_t{1} << level;
    const double side_m = size_m_ / cells;
    const double range = side_m * lod_scale_;
    const double radius_squared = range * range * reach_squared(level) - viewer_m.y * viewer_m.y;
    w.x0 = w.x1 = w.z0 = w.z1 = 0;
    if (radius_squared > 0) {
        const double radius = std::sqrt(radius_squared) / side_m;
        const double x = viewer_m.x / side_m - 0.5, z = viewer_m.z / side_m - 0.5;
        w.x0 = to_cell(x - radius, cells);
        w.x1 = to_cell(x + radius + 1, cells);
        w.z0 = to_cell(z - radius, cells);
        w.z1 = to_cell(z + radius + 1, cells);
        if (w.x0 >= w.x1 || w.z0 >= w.z1) w.x0 = w.x1 = w.z0 = w.z1 = 0;
    }
    if (level + 1 < deepest_) {
        const Window& finer = windows_[static_cast<std::size_t>(level + 1)];
        if (finer.x1 > finer.x0) {
            const bool is_empty = w.x0 == w.x1;
            const auto widen = [&](std::int32_t& low, std::int32_t& high, std::int32_t from, std::int32_t to) {
                const std::int32_t parents_from = std::max((from - 1) >> 1, 0);
                const std::int32_t parents_to = std::min((to >> 1) + 1, cells);
                low = is_empty ? parents_from : std::min(low, parents_from);
                high = is_empty ? parents_to : std::max(high, parents_to);
            };
            widen(w.x0, w.x1, finer.x0, finer.x1);
            widen(w.z0, w.z1, finer.z0, finer.z1);
        }
    }
    assert(static_cast<std::size_t>(w.x1 - w.x0) * static_cast<std::size_t>(w.z1 - w.z0) <= w.measures.size());
    for (std::int32_t z = w.z0; z < w.z1; ++z) {
        const double dz = (z + 0.5) * side_m - viewer_m.z;
        for (std::int32_t x = w.x0; x < w.x1; ++x) {
            const double dx = (x + 0.5) * side_m - viewer_m.x;
            const double distance_squared = dx * dx + dz * dz + viewer_m.y * viewer_m.y;
            w.at(x, z) = static_cast<float>(1 - distance_squared / (range * range));
        }
    }
}

void LevelMap::demand_of_parents(int level) {
    const Window& finer = windows_[static_cast<std::size_t>(level)];
    Window& coarser = windows_[static_cast<std::size_t>(level - 1)];
    for (std::int32_t z = finer.z0; z < finer.z1; ++z) {
        for (std::int32_t x = finer.x0; x < finer.x1; ++x) {
            const float g = finer.at(x, z);
            const float demand = zone + std::min(g, 0.f);
            const auto raise = [&](std::int32_t px, std::int32_t pz) {
                if (coarser.holds(px, pz)) coarser.at(px, pz) = std::max(coarser.at(px, pz), demand);
            };
            raise(x >> 1, z >> 1);
            // Two neighbours are siblings; the other two lie on this node's side of its parent.
            raise((x >> 1) + (x % 2 == 0 ? -1 : 1), z >> 1);
            raise(x >> 1, (z >> 1) + (z % 2 == 0 ? -1 : 1));
        }
    }
}

std::uint16_t LevelMap::weight(float measure) {
    const float fraction = std::clamp(measure / zone, 0.f, 1.f);
    return static_cast<std::uint16_t>(fraction * 65535.f + 0.5f);
}

int LevelMap::level_at(std::int32_t cell_x, std::int32_t cell_z) const {
    int level = 0;
    while (level < deepest_ && splits(level, cell_x >> (deepest_ - level), cell_z >> (deepest_ - level))) ++level;
    return level;
}

}  // namespace pelagic
