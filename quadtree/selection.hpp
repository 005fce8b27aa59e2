// Chooses the patches to draw: one list for all views of a frame.
//
//   Selection selection(quadtree_preset_named("high")->options(2048));
//   const DrawList& list = selection.select({.viewer_m = eyes, .views = both_eyes, .bounds = frame.bounds});
//
// The tree is walked with a stack; subtrees that no view can see are left out whole, so it visits what it draws and
// the nodes above. What is split depends on the viewer alone (level_map.hpp), never on what is seen.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <vector>

#include "pelagic/quadtree/draw_list.hpp"
#include "pelagic/quadtree/frustum.hpp"
#include "pelagic/quadtree/level_map.hpp"
#include "pelagic/quadtree/node_culling.hpp"
#include "pelagic/quadtree/quadtree_options.hpp"

namespace pelagic {

/// How far the surface leaves its rest anywhere; a frame's own extremes, or those of all frames.
struct SurfaceBounds {
    double height_min_m = 0;
    double height_max_m = 0;
    double horizontal_x_max_m = 0;  ///< largest |Dx|
    double horizontal_z_max_m = 0;

    constexpr SurfaceBounds() = default;
    constexpr SurfaceBounds(double height_min, double height_max, double horizontal_x_max, double horizontal_z_max)
        : height_min_m(height_min),
          height_max_m(height_max),
          horizontal_x_max_m(horizontal_x_max),
          horizontal_z_max_m(horizontal_z_max) {}
    /// A frame's bounds, or whatever else has members of these names: the quadtree does not know the sea.
    template <class Extremes>
    requires requires(const Extremes& e) {
        e.height_min_m, e.height_max_m, e.horizontal_x_max_m, e.horizontal_z_max_m;
    }
    constexpr SurfaceBounds(const Extremes& e)
        : SurfaceBounds(e.height_min_m, e.height_max_m, e.horizontal_x_max_m, e.horizontal_z_max_m) {}
};

struct SelectionInput {
    glm::dvec3 viewer_m{};                 ///< decides the levels; between the eyes of a headset
    std::optional<glm::dvec2> centre_m{};  ///< the grid is around it; none: around the viewer
    std::span<const glm::dmat4> views{};   ///< clip from world: both eyes, a shadow's view; none: nothing is culled
    SurfaceBounds bounds{};
    ClipDepth depth = ClipDepth::either;  ///< of all views
};

class Selection {
   public:
    /// Throws std::invalid_argument(check(options)).
    explicit Selection(const QuadtreeOptions& options);

    /// The list stays valid until the next call. Throws std::invalid_argument if a number is not finite, the viewer or
    /// the centre is further than 1e8 m from the origin, a view has no inverse, there are more than 32 or bounds are upside down; the list is
    /// then the one before. Never allocates.
    ///
    /// The grid follows the centre in steps of S/4, by which every vertex and every patch from level 2 on stays where
    /// it is; equation 69's S/(2V) keeps vertices but cuts the patches anew, which pops (errata). The waves fade out
    /// between 5/16 S and 3/8 S from the centre, which is inside of the grid wherever it snapped to.
    const DrawList& select(const SelectionInput& input);

    const DrawList& list() const { return list_; }
    /// The levels over the whole grid as of the last select().
    const LevelMap& level_map() const { return levels_; }
    const QuadtreeOptions& options() const { return options_; }

   private:
    /// A bit for each view that sees a part of a node, and for each that sees all of it.
    struct Views {
        std::uint32_t part, whole;
    };
    struct Node {
        std::int32_t level, x, z;
        Views parent;
    };
    struct Found {
        PatchInstance patch;
        std::uint8_t stitches;
    };

    QuadtreeGrid grid_around(glm::dvec2 centre_m) const;
    void walk(const SurfaceBounds& bounds);
    Views views_that_see(const Node& node) const;
    void emit(const Node& node);
    void sort_into_batches();
    void walk_border();
    void walk_side(Side side, std::int32_t level, std::int32_t along);

    QuadtreeOptions options_;
    LevelMap levels_;
    DrawList list_;
    std::vector<Frustum> frusta_, next_frusta_;
    std::vector<Node> stack_;
    std::vector<NodeCulling> culling_;  ///< of each view
    std::vector<Found> found_;
};

}  // namespace pelagic
