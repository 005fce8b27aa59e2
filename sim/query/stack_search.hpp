// Exact search for queries of several cascades. It finds all reference points that are displaced to
// a position, in double precision, by branch and bound.
//
// buffers/contraction_map.hpp proves that a box holds at most one reference point where the
// contraction is low, and bounds the distance from a known reference point to others. A box is
// discarded if it is displaced too far away: from its centre c, no cascade's displacement changes
// by more than its stretch times the distance, nor by more than |D_i(c)| plus the largest |D_i|. In
// a small box, or one that holds at most one reference point, Newton's method finds it. Other boxes
// are divided into four, down to the search's tolerance. The code is scalar and compiled once, and
// it does not allocate.
//
// The contraction bounds are those of the linear surface. Slopes of the cubic surface are sums over
// adjacent cells, with weights that may exceed 1. Its boxes are divided until the slack of those
// cells is min_cubic_slack. That is no proof: intersections in a fold that only the cubic surface
// has may be missed. They are close together.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/kernels/kernels.hpp"
#include "pelagic/sim/surface_query.hpp"

namespace pelagic {

/// A cascade as the search reads it.
struct SearchCascade {
    SearchCascade(const Cascade& cascade, Interpolation interpolation);
    SearchCascade() = default;

    SurfaceTexels texels;
    double along, across;  ///< the grid's cosine and sine, times texels_per_m
    double texels_per_m;
    Interpolation interpolation;
    ContractionBound contraction;  ///< largest_m and stretch are of the interpolated surface
};

/// A world position along the axes of each cascade: a cell, and the position in the cell.
struct StackPoint {
    std::array<std::int32_t, max_cascades> cell_x, cell_z;
    std::array<double, max_cascades> u, v;
    /// Weight of each cascade, in [0, 1]. Bounds for weight 1 hold for lower weights.
    std::array<double, max_cascades> weight = {1, 1, 1, 1};
};

/// Vector from a world position to one of its reference points, metres.
struct Offset {
    double x = 0, z = 0;
};

struct StackIntersection {
    bool found = false;
    Offset offset;
    double height_m = 0;
    double error_m = 0;
};

class StackSearch {
   public:
    /// \param target_m  largest distance of a solution from the position, metres
    StackSearch(std::span<const SearchCascade> cascades, double target_m)
        : cascades_(cascades), target_m_(target_m) {}

    /// Returns whether a known reference point is proven to be the only one, from the bounds r_i of
    /// contraction_map.hpp with the slacks around it. Like the map, the proof is for the linear
    /// surface.
    bool is_only_one(const StackPoint& point, Offset known) const;
    /// Returns the highest of the surface's intersections with the vertical line through a
    /// position.
    /// \param known  reference point of one of them; may be null
    StackIntersection highest_intersection(const StackPoint& point, const Offset* known) const;

   private:
    struct Drawn;
    struct Intersections;
    struct Box;

    bool may_reach(const StackPoint& point, const Box& box, double& distance) const;
    double distance_at(const StackPoint& point, Offset offset) const;
    Drawn drawn_at(const StackPoint& point, Offset offset) const;
    double height_at(const StackPoint& point, Offset offset) const;
    double slack_within(const StackPoint& point, Offset centre, double reach_m, std::size_t cascades,
                        bool is_square) const;
    double contraction_within(const StackPoint& point, std::size_t cascade, Offset centre, double reach) const;
    Box around_known(const StackPoint& point, Offset known) const;
    bool step_towards(const StackPoint& point, Offset& offset) const;
    void search_box(const StackPoint& point, const Box& box, Intersections& intersections) const;

    std::span<const SearchCascade> cascades_;
    double target_m_;
};

}  // namespace pelagic
