// Which nodes of the tree are split, and how far each split has gone: known everywhere, whatever the views see.
//
// A node of side s whose centre is at distance d from the viewer has the measure
//
//   g = 1 - d^2 / (tau s)^2          split if g > 0 (VR Ocean, equation 57, in squares)
//
// and its children's extra vertices get the weight clamp(g / k, 0, 1): they start on the node's own surface and reach
// their place as the viewer comes nearer, so nothing pops. Two things must hold for that to close without cracks:
// neighbours differ by at most one level, and a node whose surface is being left must itself have arrived. Both follow
// from one rule, applied from the finest level up: for each node m of measure g, the parent of m and the parents of the
// four neighbours of m have at least the measure k + min(g, 0), so that they have arrived when m begins. With tau >= 1.58 the rule hardly ever adds a split;
// below, equation 57 alone leaves neighbours two levels apart (errata).
//
// Only nodes near the viewer are looked at: a window of a few cells for each level, so the cost does not grow with S^2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "pelagic/quadtree/quadtree_options.hpp"

namespace pelagic {

class LevelMap {
   public:
    /// k above: the part of the squared distance over which a split goes from 0 to 1.
    static constexpr double morph_zone = 0.25;

    /// \pre check(options) is empty
    explicit LevelMap(const QuadtreeOptions& options);

    /// Looks from a viewer, metres from the grid's corner (lowest x and z), y over the rest level. Never allocates.
    void update(const glm::dvec3& viewer_m);

    /// More are never drawn, wherever the viewer is.
    std::size_t max_patches() const;

    int deepest_level() const { return deepest_; }
    /// Cells of the finest level along a side.
    std::int32_t width() const { return std::int32_t{1} << deepest_; }

    /// g of the node (x, z) of that level, raised by what others demand; any level, x and z: -1 where nothing is split.
    float measure(int level, std::int32_t x, std::int32_t z) const {
        if (level < 0 || level >= deepest_) return -1;
        const Window& w = windows_[static_cast<std::size_t>(level)];
        return w.holds(x, z) ? w.at(x, z) : -1;
    }
    /// The node is drawn as its children.
    bool splits(int level, std::int32_t x, std::int32_t z) const { return measure(level, x, z) > 0; }

    /// 0 to 65535, from a node's measure: how far the vertices that its children add have come. 0 unless it is split.
    static std::uint16_t weight(float measure);

    /// The level drawn over a cell of the finest level; the deepest one that splits allows.
    int level_at(std::int32_t cell_x, std::int32_t cell_z) const;

   private:
    /// Measures of the nodes [x0, x1) x [z0, z1) of one level; what lies beside it is not split and demands nothing.
    struct Window {
        std::int32_t x0 = 0, x1 = 0, z0 = 0, z1 = 0;
        std::vector<float> measures;

        bool holds(std::int32_t x, std::int32_t z) const { return x >= x0 && x < x1 && z >= z0 && z < z1; }
        float& at(std::int32_t x, std::int32_t z) {
            return measures[static_cast<std::size_t>(z - z0) * static_cast<std::size_t>(x1 - x0) +
                            static_cast<std::size_t>(x - x0)];
        }
        float at(std::int32_t x, std::int32_t z) const { return const_cast<Window*>(this)->at(x, z); }
    };

    void open_window(int level, const glm::dvec3& viewer_m);
    void demand_of_parents(int level);

    double size_m_;
    double lod_scale_;
    int deepest_;
    std::vector<Window> windows_;  ///< of levels 0 to deepest - 1, which can split
};

}  // namespace pelagic
