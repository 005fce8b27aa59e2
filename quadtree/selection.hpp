// Selection of the patches to draw: one draw list for all views of a frame.
//
//   Selection selection(quadtree_preset_named("high")->options(2048));
//   const DrawList& list = selection.select({.viewer_m = eyes, .views = both_eyes,
//                                            .bounds = frame.bounds});
//
// The tree is traversed with a stack. Subtrees that no view can see are skipped, so that only
// visible nodes and their ancestors are visited. Splits depend on the viewer's position only
// (level_map.hpp), never on the views.
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
#include "pelagic/sim/frame_bounds.hpp"

namespace pelagic {

struct SelectionInput {
    glm::dvec3 viewer_m{};                 ///< defines the levels; for a headset, between the eyes
    std::optional<glm::dvec2> centre_m{};  ///< x and z of the grid's centre; default: the viewer
    /// View-projection matrices, for instance of both eyes and a shadow; if empty, nothing is
    /// culled.
    std::span<const glm::dmat4> views{};
    FrameBounds bounds{};                 ///< of a frame or of all frames
    double sea_level_m = 0;               ///< height of still water in the world; within 1e8 m of 0
    ClipDepth depth = ClipDepth::either;  ///< depth range of all views
};

class Selection {
   public:
    /// \throws std::invalid_argument  if check(options) is not empty
    explicit Selection(const QuadtreeOptions& options);

    /// Computes the draw list, which stays valid until the next call. Never allocates.
    ///
    /// The grid follows the centre in steps of S/4. Every vertex, and every patch from level 2 on,
    /// keeps its position. The step of equation 69, S/(2V), keeps vertices but changes the patches,
    /// which is visible as popping (errata). The waves fade out between 5/16 S and 3/8 S from the
    /// centre, which is inside the grid for every snapped position.
    /// \throws std::invalid_argument  if a number is not finite, the viewer or the centre is
    ///                                further than 1e8 m from the origin, a view is singular, there
    ///                                are more than 32 views, or a minimum exceeds its maximum;
    ///                                list() then stays unchanged
    const DrawList& select(const SelectionInput& input);

    /// Returns the draw list of the last select().
    const DrawList& list() const { return list_; }
    /// Returns the levels over the whole grid of the last select().
    const LevelMap& level_map() const { return levels_; }
    /// Returns the options of construction.
    const QuadtreeOptions& options() const { return options_; }

   private:
    /// One bit for each view that sees a node partially or wholly.
    struct Views {
        std::uint32_t partial, whole;
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
    void walk(const FrameBounds& bounds);
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
    std::vector<NodeCulling> culling_;  ///< one for each view
    std::vector<Found> found_;
};

}  // namespace pelagic
