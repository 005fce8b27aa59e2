// How much of a sea lies under foam that lasts: water that folds turns white at once, and fades.
//
// Let z be how many deviations the Gaussian that stands for the Jacobian lies below its mean, and foam rise from 0 at z_w - s/2 to 1
// at z_w + s/2. It fades from 1 to 0 within F seconds, so water has more foam than y if z was above b(a) = z_w + s (y - 1/2 + a/F)
// some time a ago: a boundary that falls by s/F a second until it is at b_y = z_w + s (y - 1/2) now. From when it was at
// b_1 = z_w + s/2, where all are white, z crosses it upwards (Rice 1945, section 3.3, for a boundary that moves)
//
//   n(y) = int_0^((1 - y) F) p(b(a)) E[(dz/dt + s/F)^+] da = (P(b_y) - P(b_1)) (p(c) + c (1 - P(c))) / c,  c = s / (F w)
//
// times, where p and P are the normal density and what lies above, and w^2 the mean square of dz/dt at what floats there and drifts. Crossings come by chance, from
// water that isn't white (Vanmarcke 1975), so the part of the sea under more foam than y, and the cover are
//
//   1 - (1 - P(b_1)) exp(-n(y) / (1 - P(b_1))),   and its integral over y.
//
// Foam is made at ticks d apart. A stay above z lasts 2 V / (z w), V Rayleigh's (a parabola), so of the crossings the part
// E min(1, 2 V / (z w d)) = sqrt(2 pi) (1/2 - P(r)) / r, r = z w d / 2, is seen.
#pragma once

namespace pelagic {

class FoamAccumulation {
   public:
    /// s. A crest that rises above z does so by about 1/z, and by more than s in exp(-s z) of all cases: a third of the crests that
    /// make foam have a white core in light winds (z = 3.6), six of ten in a storm (1.7), and the others' edges are no harder.
    static constexpr double ramp_deviations = 0.3;
    /// F in ticks.
    static constexpr double fading_ticks = 255.0 / 9;

    /// \param frequency_radps  w, above 0
    FoamAccumulation(double frequency_radps, double tick_s);

    /// Part of the sea under foam in the mean. \param level  z_w, in [0, 9]
    double cover(double level) const;

    /// z_w of a cover in (0, 0.4], in [0, 9]: within 1e-4 where there is one.
    double level_of(double cover) const;

   private:
    double half_turn_of_tick_;
    double crossings_;  ///< n(y) / (P(b_y) - P(b_1))
};

}  // namespace pelagic
