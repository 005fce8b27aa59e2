// The displaced surface of a frame in double, by exhaustive search: bilinear between texels, every
// reference point whose displaced position is a given point. The search uses no fold maps, Newton
// steps from the point, or analytic solutions.
#pragma once

#include <cstdint>
#include <vector>

#include "pelagic/tests/oracle/gradient_oracle.hpp"

namespace pelagic::oracle {

/// A reference point, in texels from the origin of the patch: the cell and the position in it.
struct ReferencePoint {
    int i, j;
    double u, v;
};

/// A reference point whose displaced position is the queried point, and its height.
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

    /// Returns all intersections above a point of the world, highest first.
    std::vector<Intersection> intersections_at(double x_m, double z_m) const;

    /// Interpolates bilinearly between texels.
    double value_at(const Plane& plane, const ReferencePoint& rest) const;
    /// Computes normal and Jacobian from central differences at texels, bilinear between them.
    SurfaceFacts facts_at(const ReferencePoint& rest) const;
    const Displacement& displacement() const { return planes_; }

   private:
    /// A cell, shifted by whole patches so that its displaced position is in the first patch.
    struct Candidate {
        int i, j;
    };
    struct Corner {
        double x, z;
    };
    Corner drawn(const Candidate& cell, double u, double v) const;
    void search(const Candidate& cell, Corner point, double u, double v, double size,
                std::vector<Intersection>& intersections) const;
    void refine(const Candidate& cell, Corner point, double u, double v,
                std::vector<Intersection>& intersections) const;

    int n_;
    double texel_m_;
    Displacement planes_;
    Plane slopes_[6];                 ///< dx, height, dz along x, then along z
    std::vector<std::size_t> first_;  ///< index into candidates_, for each square of the world
    std::vector<Candidate> candidates_;
};

}  // namespace pelagic::oracle
