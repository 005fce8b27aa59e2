// Upper bound of the difference of the water's height between two positions.
//
// Let q and q' be reference points of positions d apart. For each cascade, over its whole domain,
// let e_i be the largest horizontal displacement, -s_i the smallest eigenvalue as in
// buffers/contraction_map.hpp, and g_i the largest slope of the heights over reference points. For
// any number k of the coarsest cascades with m = 1 - s_0 - ... - s_(k-1) > 0,
//
//   m |q' - q| <= |C(q') - C(q)| <= d + 2 (e_k + e_(k+1) + ...),
//   C(q) = q + D_0(q) + ... + D_(k-1)(q)
//
// and no cascade's height changes by more than g_i |q' - q|, nor by more than its range. In folds,
// the bound holds for every intersection.
//
// At a shore, cascades have weights a_i <= 1 that change by at most c per metre. Then d is replaced
// by d (1 + c (e_0 + e_1 + ...)), and each height changes by up to c d more, times the largest
// |height| of its cascade: a h - a' h' = a (h - h') + (a - a') h'.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

class HeightChange {
   public:
    /// \param cascades               of a frame with several, made with OceanOptions::queries
    /// \param dynamic_waves_range_m  range of the heights that dynamic waves and a shore add,
    ///                               metres
    /// \param weights_change_per_m     c, 1/m
    /// Computes the largest slope of the heights unless another ray of the frame did. Thread-safe.
    HeightChange(std::span<const Cascade> cascades, const Kernels& kernels, double dynamic_waves_range_m = 0,
                 double weights_change_per_m = 0);

    /// Returns the upper bound for positions at a horizontal distance, metres.
    double within(double distance_m) const;

    /// Returns whether a ray stays on one side of the water for a distance.
    /// \param clearance_m  vertical distance of the ray's start from the water, metres
    /// \param horizontal   horizontal component of the ray's unit vector, absolute
    /// \param vertical     vertical component of the ray's unit vector, absolute
    bool is_free(double clearance_m, double horizontal, double vertical, double distance_m) const {
        return within(distance_m * horizontal) + distance_m * vertical < clearance_m;
    }
    /// Returns a distance, at most `max_m`, for which is_free() is true.
    double free_distance(double clearance_m, double horizontal, double vertical, double max_m) const;

   private:
    struct Bound {
        double steepness, range_m;
        double slack;      ///< 1 - s_0 - ... - s_(i-1)
        double further_m;  ///< 2 (e_i + e_(i+1) + ...)
    };
    std::array<Bound, max_cascades + 1> bounds_;  ///< by cascade; the last one follows all cascades
    std::size_t count_;
    double dynamic_waves_range_m_;
    double stretch_ = 1;        ///< 1 + c (e_0 + e_1 + ...)
    double highest_per_m_ = 0;  ///< c times the sum of the cascades' largest |height|
};

}  // namespace pelagic
