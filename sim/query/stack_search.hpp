// The exact search for queries of several cascades: all reference points that are drawn at a place, in double, by branch and bound.
//
// buffers/contraction_map.hpp says why a box holds at most one of them where the cascades contraction little, and how far from a known
// one others can be. A box is left out if it is drawn too far away: from its centre c, no cascade's displacement changes by more
// than its stretch times the distance, nor by more than |D_i(c)| and the largest |D_i| together. Where a box holds at most one, or
// is small, Newton's steps find it. What is neither is cut in four, down to the search's tolerance. Plain code, compiled once
// for everybody; nothing is allocated.
//
// The maps are of the linear surface. A cubic one's slopes are sums of those of the cells around, with weights that may exceed 1: it
// is cut until the contracts of those cells leave plenty. That is no proof, and intersections of a fold that the linear surface has not are
// lost; they are close together.
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
    double along, across;  ///< the grid's cosine and sine, times texels a metre
    double texels_per_m;
    Interpolation interpolation;
    ContractionBound contraction;  ///< its largest displacement and its stretch are those of the interpolated surface
};

/// Where a point of the world is along the axes of each cascade: a cell, and where in it.
struct StackPoint {
    std::array<std::int32_t, max_cascades> cell_x, cell_z;
    std::array<double, max_cascades> u, v;
    /// Of each cascade's displacement that counts there, 0 to 1: what is proven of whole cascades holds of less.
    std::array<double, max_cascades> part = {1, 1, 1, 1};
};

/// From a point of the world to what rests where it is drawn, metres.
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
    /// \param target_m  how near is near enough
    StackSearch(std::span<const SearchCascade> cascades, double target_m)
        : cascades_(cascades), target_m_(target_m) {}

    /// The highest of the intersections over a point.
    /// \param known  where one of them rests, or null
    StackIntersection highest_intersection(const StackPoint& point, const Offset* known) const;

   private:
    struct Drawn;
    struct Intersections;
    struct Box;

    Drawn drawn_at(const StackPoint& point, Offset offset) const;
    double height_at(const StackPoint& point, Offset offset) const;
    double slack_within(const StackPoint& point, Offset centre, double reach_m, std::size_t cascades,
                        bool is_square) const;
    double contraction_within(const StackPoint& point, std::size_t cascade, Offset centre, double reach) const;
    Box around_known(const StackPoint& point, Offset known) const;
    bool step_towards(const StackPoint& point, Offset& offset) const;
    void look_into(const StackPoint& point, const Box& box, Intersections& intersections) const;

    std::span<const SearchCascade> cascades_;
    double target_m_;
};

}  // namespace pelagic
