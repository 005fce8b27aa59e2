// How much the height of the water can differ between two places.
//
// Let q and q' be reference points of places d apart, e_i, -s_i and g_i a cascade's largest horizontal displacement, its least eigenvalue
// as in buffers/contraction_map.hpp, over the whole cascade, and the steepest its heights are at rest. For any number k of the coarsest
// cascades that leave m = 1 - s_0 - ... - s_(k-1) > 0,
//
//   m |q' - q| <= |C(q') - C(q)| <= d + 2 (e_k + e_(k+1) + ...),      C(q) = q + D_0(q) + ... + D_(k-1)(q)
//
// and no cascade's height changes by more than g_i |q' - q|, nor by more than from its lowest to its highest. Folds are no exception:
// it holds for every intersection.
//
// At a shore cascades count with parts a_i <= 1 of places, which change by c a metre at most: d (1 + c (e_0 + e_1 + ...)) takes d's place
// then, and each height changes by another c d of the largest |height| of its cascade: a h - a' h' = a (h - h') + (a - a') h'.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "pelagic/sim/cascade.hpp"
#include "pelagic/sim/kernels/kernels.hpp"

namespace pelagic {

class HeightChange {
   public:
    /// \param cascades          of a frame of several, made with OceanOptions::queries
    /// \param dynamic_waves_range_m  what adds to them wherever water is drawn has that from its lowest to its highest
    /// \param parts_change_per_m  c
    explicit HeightChange(std::span<const Cascade> cascades, double dynamic_waves_range_m = 0,
                          double parts_change_per_m = 0);

    /// Metres, at most, between places so far apart.
    double within(double distance_m) const;

    /// Whether a ray that is `clearance_m` above or below the water stays on that side for so long. It covers `ground` along
    /// the ground and `rise` upwards or downwards of each metre.
    bool is_free(double clearance_m, double ground, double rise, double distance_m) const {
        return within(distance_m * ground) + distance_m * rise < clearance_m;
    }
    /// How long it stays there for certain, at most `max_m`.
    double free_distance(double clearance_m, double ground, double rise, double max_m) const;

   private:
    struct Part {
        double steepness, range_m;
        double slack;      ///< what the cascades before this leave of 1
        double further_m;  ///< 2 (e_i + e_(i+1) + ...)
    };
    std::array<Part, max_cascades + 1> parts_;  ///< the last one after all cascades
    std::size_t count_;
    double dynamic_waves_range_m_;
    double stretch_ = 1;        ///< of ways, by what the parts change
    double highest_per_m_ = 0;  ///< of heights, by the same
};

}  // namespace pelagic
