// The displaced surface of a sum of cascades in double, by exhaustive search. A square of reference
// points is excluded only if the bounding box of its displaced points, from the cascades' values,
// does not contain the point. Other squares are divided into four, down to a fraction of the finest
// texel. The search uses no contraction maps, slopes or bounds of the search distance.
#pragma once

#include <vector>

#include "pelagic/sim/frame.hpp"
#include "pelagic/sim/surface_query.hpp"
#include "pelagic/tests/oracle/surface_oracle.hpp"

namespace pelagic::oracle {

/// A reference point in world coordinates and its height, in m.
struct StackIntersection {
    double x_m, z_m, height_m;
};

class Stack {
   public:
    explicit Stack(const Frame& frame, Interpolation interpolation = Interpolation::linear);

    /// Returns all intersections above a point of the world, highest first.
    std::vector<StackIntersection> intersections_at(double x_m, double z_m) const;
    /// Computes normal and Jacobian. Linear: from central differences at texels, bilinear between
    /// them, rotated into world axes and summed. Cubic: from differences of interpolated values
    /// over a small fraction of a texel.
    SurfaceFacts facts_at(double reference_x_m, double reference_z_m) const;

    struct Vector {
        double x, y, z;
    };
    Vector displacement_at(double reference_x_m, double reference_z_m) const;
    Vector velocity_at(double reference_x_m, double reference_z_m) const;

   private:
    struct Range {
        double min, max;
    };
    struct Layer {
        int n;
        double texel_m, cosine, sine;
        std::vector<double> dx, height, dz, velocity_x, velocity_y, velocity_z;
        Range dx_range, dz_range;
        Interpolation interpolation;

        double at(const std::vector<double>& plane, int i, int j) const;
        double value(const std::vector<double>& plane, double u, double v) const;
        double cubic_value(const std::vector<double>& plane, double u, double v) const;
        double slope(const std::vector<double>& plane, double u, double v, bool is_across) const;
        Range range(const std::vector<double>& plane, Range all, double u, double v, double reach) const;
        double along(double x_m, double z_m) const { return (cosine * x_m + sine * z_m) / texel_m; }
        double across(double x_m, double z_m) const { return (cosine * z_m - sine * x_m) / texel_m; }
    };
    Vector sum(double x_m, double z_m, const std::vector<double> Layer::*x, const std::vector<double> Layer::*y,
               const std::vector<double> Layer::*z) const;
    void search(double point_x, double point_z, double x, double z, double half,
                std::vector<StackIntersection>& intersections) const;
    void refine(double point_x, double point_z, double x, double z, double half,
                std::vector<StackIntersection>& intersections) const;

    std::vector<Layer> layers_;
    double reach_m_ = 0;
};

}  // namespace pelagic::oracle
