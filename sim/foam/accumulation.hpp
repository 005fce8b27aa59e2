// Fraction of the sea covered by accumulated foam: breaking water turns white at once, and the foam
// decays.
//
// Let z be the number of standard deviations by which the Gaussian that models the Jacobian is
// below its mean. Foam rises from 0 at z_w - s/2 to 1 at z_w + s/2, and decays from 1 to 0 in F
// seconds. So water has more foam than y if, at some time a ago, z was above the boundary
//
//   b(a) = z_w + s (y - 1/2 + a/F).
//
// The boundary falls by s/F per second and is at b_y = z_w + s (y - 1/2) now. After the time at
// which it was at b_1 = z_w + s/2, above which all water is white, z crosses it upwards
//
//   n(y) = int_0^((1 - y) F) p(b(a)) E[(dz/dt + s/F)^+] da
//        = (P(b_y) - P(b_1)) (p(c) + c (1 - P(c))) / c,  c = s / (F w)
//
// times (Rice 1945, section 3.3, for a moving boundary). Here p is the normal density, P the upper
// tail probability, and w^2 the mean square of dz/dt at drifting foam. Crossings are random and
// start from water that is not white (Vanmarcke 1975). So the fraction of the sea under more foam
// than y, and the cover, are
//
//   1 - (1 - P(b_1)) exp(-n(y) / (1 - P(b_1))),   and its integral over y.
//
// Foam is generated at ticks d apart. A stay above z lasts 2 V / (z w), with V Rayleigh distributed
// (parabolic approximation). So the fraction of crossings that a tick samples is
//
//   E min(1, 2 V / (z w d)) = sqrt(2 pi) (1/2 - P(r)) / r,   r = z w d / 2.
//
// All this is a fraction of undisplaced water. Crests contract the water, so foam covers less of
// the sea's area: E[(1 + T) foam], where T is the divergence of the displacement now. With the
// covariances E[T(t) z(t - a)] = -k(a) of Gaussians, E[T foam] is the derivative of the cover with
// respect to e where b(a) + e k(a) is the boundary (Stein 1981). With Q = 1 - P and h = p / Q, water
// that has less foam than y has had no crossing from below the boundary, in time A = (1 - y) F:
//
//   ln Q_y = ln Q(b_1) - f int_0^A p(b) E[(dz/dt + s/F)^+] / Q(b) da,   f: fraction that ticks sample
//   d ln Q_y / de = h(b_1) k(A) + f (w p(c) int_0^A (b + h) h k da + Q(c) (h(b_y) k(0) - h(b_1) k(A)))
//
// where k' of the boundary's slope is integrated by parts. The cover of the area is the integral
// over y of 1 - Q_y (1 + d ln Q_y / de).
#pragma once

#include <array>

#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

/// Returns the fraction of the sea that whitecaps cover: 3.84e-6 U10^3.41, at most 0.4 (Monahan and
/// O'Muircheartaigh 1980). \param wind_speed_mps  U10, m/s
double whitecap_cover(double wind_speed_mps);
/// Returns whether the sea contains waves that its wind raises, and therefore whitecaps: a wind sea, or
/// a system by wind, or one whose peak runs at less than 1.2 times the wind's component along it (the
/// criterion of ECMWF's wave model for a wind sea). A swell alone does not break. No pond wave does,
/// and no analytic wave: their steepness of at most 0.4 is below the limit k A = 0.443 (Michell 1893).
bool has_whitecaps(const SeaState& sea);
/// Returns the whitecap cover of a sea: that of its wind, or 0 if it has none.
double whitecap_cover(const SeaState& sea);

class FoamAccumulation {
   public:
    /// s. A crest that exceeds z does so by about 1/z, and by more than s with probability
    /// exp(-s z). So 34 % of the crests that make foam have a fully white core in light winds
    /// (z = 3.6), and 60 % in a storm (z = 1.7). The edges of the other crests are no sharper.
    static constexpr double ramp_deviations = 0.3;
    /// F, in ticks.
    static constexpr double fading_ticks = 15;

    /// \param frequency_radps  w, rad/s, above 0
    /// \param tick_s           d, seconds, above 0
    /// \param ramp             s, deviations, above 0
    FoamAccumulation(double frequency_radps, double tick_s, double ramp = ramp_deviations);

    double fall() const { return fall_; }  ///< c
    /// Returns the mean fraction of undisplaced water under foam. \param level  z_w, in [0, 9]
    double cover(double level) const;

    /// k(a) at ages of 0, 1, 2 to 15 ticks.
    using Contraction = std::array<double, 16>;
    /// Returns the mean fraction of the sea's area under foam.
    double cover_of_area(double level, const Contraction& contraction) const;
    /// Returns z_w, in [0, 9], for a cover in (0, 0.4]; error below 1e-4 if a solution exists.
    double level_of_area(double cover, const Contraction& contraction) const;

   private:
    double sampled(double level) const;  ///< f

    double ramp_;
    double half_turn_of_tick_;
    double fall_;       ///< c
    double crossings_;  ///< n(y) / (P(b_y) - P(b_1))
};

}  // namespace pelagic
