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
#pragma once

namespace pelagic {

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

    /// Returns the mean fraction of the sea under foam. \param level  z_w, in [0, 9]
    double cover(double level) const;

    /// Returns z_w, in [0, 9], for a cover in (0, 0.4]; error below 1e-4 if a solution exists.
    double level_of(double cover) const;

   private:
    double ramp_;
    double half_turn_of_tick_;
    double crossings_;  ///< n(y) / (P(b_y) - P(b_1))
};

}  // namespace pelagic
