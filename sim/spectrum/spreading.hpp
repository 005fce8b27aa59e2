// How wave energy spreads around the direction in which waves run.
#pragma once

#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

/// Values of a wave and of the one that runs against it.
struct OppositeDensities {
    double along, against;
};

/// D(theta) = |cos theta|^s, s = 1 + 5 alpha^2, times sigma(alpha) = 0.01 + 0.49 (1 - alpha)^2 for waves that run
/// against the wind (VR Ocean, equations 6 to 9; the paper has no constant in front of it). The same for all frequencies.
class PaperSpreading {
   public:
    /// \param alignment  alpha in [0, 1]
    explicit PaperSpreading(double alignment);

    /// The paper's values of a cosine of the angle between wave and wind, and of its negative.
    OppositeDensities weights(double cosine) const;

    /// weights() divided by the integral over all directions, 1/rad, so that it moves energy without adding any.
    OppositeDensities densities(double cosine) const {
        const OppositeDensities both = weights(cosine);
        return {both.along / integral_, both.against / integral_};
    }

   private:
    double exponent_;
    double opposing_;
    double integral_;
};

/// A lobe around one direction, 1/rad; its integral over all directions is 1.
class DirectionalLobe {
   public:
    /// All directions alike.
    DirectionalLobe() = default;
    /// cos(theta/2)^(2 s) (Longuet-Higgins, Cartwright and Smith 1963). \pre s >= 0; 0 is all directions alike
    static DirectionalLobe cosine_2s(double s);
    /// sech(beta theta)^2 (Donelan, Hamilton and Hui 1985). \pre beta > 0
    static DirectionalLobe sech_squared(double beta);

    OppositeDensities densities(double cosine) const;

   private:
    enum class Shape { cosine_2s, sech_squared };
    DirectionalLobe(Shape shape, double narrowness, double factor)
        : shape_(shape), narrowness_(narrowness), factor_(factor) {}

    Shape shape_ = Shape::cosine_2s;
    double narrowness_ = 0;                ///< s or beta
    double factor_ = 0.15915494309189534;  ///< 1 / integral
};

/// s of the cosine-2s lobe whose directions have that standard deviation: 2/sigma^2 - 1, because sigma^2 = 2 (1 - r1) with the
/// first circular moment r1 = s/(s + 1) (Kuik, van Vledder and Holthuijsen 1988). \param sigma_rad in (0, sqrt 2]
double cosine_2s_exponent(double sigma_rad);

/// What was found out about the waves of a wind by buoys and wave staffs: the lobe of each frequency.
class MeasuredSpreading {
   public:
    /// \param model  not `paper`
    /// \param peak_radps  frequency at which the wind sea's spectrum peaks
    /// \param inverse_wave_age  U/c, wind over the peak's phase speed. Beyond the 0.83 (a fully developed sea) to 5 that
    ///     Donelan et al. 1985 had, the nearest of these counts.
    MeasuredSpreading(SpreadingModel model, double peak_radps, double inverse_wave_age);

    DirectionalLobe at(double omega) const;

   private:
    SpreadingModel model_;
    double peak_radps_;
    double inverse_wave_age_;
    double largest_s_;  ///< of Mitsuyasu, at the peak
};

}  // namespace pelagic
