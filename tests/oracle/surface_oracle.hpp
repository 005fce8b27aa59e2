// The displaced surface of a frame in double, by looking everywhere: bilinear between texels, every reference point that is
// drawn at a world point. Knows nothing of fold maps, Newton's steps from the point, or closed forms.
#pragma once

#include <cstdint>
#include <vector>

#include "pelagic/tests/oracle/gradient_oracle.hpp"

namespace pelagic::oracle {

/// A reference point, in texels from the origin of the patch: the cell and where in it.
struct ReferencePoint {
    int i, j;
    double u, v;
};

/// One of the reference points that are drawn at a world point.
struct Intersection {
    ReferencePoint rest;
    double height;
};

struct SurfaceFacts {
    double normal_x, normal_y, normal_z, jacobian;
};

class Surface {
   public:
    Surface(const Frame& frame, double patch_size_m);

    /// All intersections over a world point, highest first.
    std::vector<Intersection> intersections_at(double x_m, double z_m) const;

    /// Bilinear between texels.
    double value_at(const Plane& plane, const ReferencePoint& rest) const;
    /// From slopes by central differences at texels, bilinear between them.
    SurfaceFacts facts_at(const ReferencePoint& rest) const;
    const Displacement& displacement() const { return planes_; }

   private:
    /// A cell, moved by whole patches so that it is drawn in the first one.
    struct Candidate {
        int i, j;
    };
    struct Corner {
        double x, z;
    };
    Corner drawn(const Candidate& cell, double u, double v) const;
    void look_inside(const Candidate& cell, Corner point, double u, double v, double size,
                     std::vector<Intersection>& intersections) const;
    void refine(const Candidate& cell, Corner point, double u, double v,
                std::vector<Intersection>& intersections) const;

    int n_;
    double texel_m_;
    Displacement planes_;
    Plane slopes_[6];                 ///< dx, height, dz along x, then along z
    std::vector<std::size_t> first_;  ///< of each square of the world, in candidates_
    std::vector<Candidate> candidates_;
};

}  // namespace pelagic::oracle
