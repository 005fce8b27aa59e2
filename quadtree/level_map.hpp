// The level of detail over the whole grid: which nodes are split, and the morph weight of each
// split. It is independent of the views.
//
// A node of side s whose centre is at distance d from the viewer has the measure
//
//   g = 1 - d^2 / (tau s)^2          split if g > 0 (VR Ocean, equation 57, in squares)
//
// The extra vertices of its children have the weight clamp(g / k, 0, 1). They start on the node's
// own surface and reach their own position as the viewer approaches, so that no vertex pops. The
// surface has no cracks under two conditions: neighbours differ by at most one level, and a node
// that morphs into its children has full weight itself. Both follow from one rule, applied from the
// finest level to the coarsest: for each node m of measure g, the parent of m and the parents of
// the four neighbours of m have at least the measure k + min(g, 0). They therefore have full weight
// when the split of m begins. With tau >= 1.58 the rule rarely adds a split; below, equation 57
// alone leaves neighbours two levels apart (errata).
//
// Each level stores only a window of a few nodes near the viewer, so the cost does not grow with
// S^2.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "pelagic/quadtree/quadtree_options.hpp"

namespace pelagic {

class LevelMap {
   public:
    /// k in the rule above: the fraction of the squared distance over which a split's weight goes
    /// from 0 to 1.
    static constexpr double morph_zone = 0.25;

    /// \throws std::invalid_argument  check(options), unless it is empty
    explicit LevelMap(const QuadtreeOptions& options);

    /// Computes the levels for a viewer. Never allocates.
    /// \param viewer_m  x and z relative to the grid's corner (lowest x and z), y above the
    ///                  undisplaced level
    void update(const glm::dvec3& viewer_m);

    /// Returns an upper bound of the number of patches for any viewer position.
    std::size_t max_patches() const;

    /// Returns the finest level; 0 is the whole grid.
    int deepest_level() const { return deepest_; }
    /// Returns the number of cells of the finest level along a side.
    std::int32_t width() const { return std::int32_t{1} << deepest_; }

    /// Returns g of the node (x, z) of a level, raised by the rule above; -1 outside the level's
    /// window. Accepts any level, x and z.
    float measure(int level, std::int32_t x, std::int32_t z) const {
        if (level < 0 || level >= deepest_) return -1;
        const Window& w = windows_[static_cast<std::size_t>(level)];
        return w.holds(x, z) ? w.at(x, z) : -1;
    }
    /// Returns true if the node is drawn as its children.
    bool splits(int level, std::int32_t x, std::int32_t z) const { return measure(level, x, z) > 0; }

    /// Returns the morph weight, 0 to 65535, of the vertices that a node's children add. It is 0
    /// for a node that is not split.
    static std::uint16_t weight(float measure);

    /// Returns the level that is drawn over a cell of the finest level.
    int level_at(std::int32_t cell_x, std::int32_t cell_z) const;

   private:
    /// Measures of the nodes [x0, x1) x [z0, z1) of one level. Other nodes are not split and demand
    /// nothing.
    struct Window {
        std::int32_t x0 = 0, x1 = 0, z0 = 0, z1 = 0;
        std::vector<float> measures;

        /// Returns whether a cell is inside.
        bool holds(std::int32_t x, std::int32_t z) const { return x >= x0 && x < x1 && z >= z0 && z < z1; }
        /// Returns the measure of a cell. \pre holds(x, z)
        float& at(std::int32_t x, std::int32_t z) {
            return measures[static_cast<std::size_t>(z - z0) * static_cast<std::size_t>(x1 - x0) +
                            static_cast<std::size_t>(x - x0)];
        }
        /// Returns the measure of a cell. \pre holds(x, z)
        float at(std::int32_t x, std::int32_t z) const { return const_cast<Window*>(this)->at(x, z); }
    };

    void open_window(int level, const glm::dvec3& viewer_m);
    void demand_of_parents(int level);

    double size_m_;
    double lod_scale_;
    int deepest_;
    std::vector<Window> windows_;  ///< one for each level from 0 to deepest - 1, which can split
};

}  // namespace pelagic
