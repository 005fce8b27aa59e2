// Directional spreading of wave energy.
#pragma once

#include "pelagic/sim/sea_state.hpp"

namespace pelagic {

/// Values of a wave and of the wave in the opposite direction.
struct OppositeDensities {
    double along, against;
};

/// D(theta) = |cos theta|^s, s = 1 + 5 alpha^2, times sigma(alpha) = 0.01 + 0.49 (1 - alpha)^2 for
/// waves against the wind (VR Ocean, equations 6 to 9; the paper has no normalisation constant). D
/// does not depend on frequency.
class PaperSpreading {
   public:
    /// \param alignment  alpha in [0, 1]
    explicit PaperSpreading(double alignment);

    /// Returns the paper's values for the cosine of the angle between wave and wind, and for its
    /// negative.
    OppositeDensities weights(double cosine) const;

    /// Returns weights() divided by their integral over all directions, 1/rad, so that spreading
    /// conserves energy.
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
    /// Uniform over all directions.
    DirectionalLobe() = default;
    /// cos(theta/2)^(2 s) (Longuet-Higgins, Cartwright and Smith 1963). \pre s >= 0; 0 is uniform
    /// over all directions
    static DirectionalLobe cosine_2s(double s);
    /// sech(beta theta)^2 (Donelan, Hamilton and Hui 1985). \pre beta > 0
    static DirectionalLobe sech_squared(double beta);

    OppositeDensities densities(double cosine) const;

    /// Smallest width of narrower(), in that of the lobe.
    static constexpr double least_narrowed = 0.5;
    /// Returns the lobe with its variance of directions reduced by `variance_rad2`, which is 2/(s + 1)
    /// of cosine-2s and pi^2 / (12 beta^2) of sech^2.
    DirectionalLobe narrower(double variance_rad2) const;

   private:
    enum class Shape { cosine_2s, sech_squared };
    DirectionalLobe(Shape shape, double narrowness, double factor)
        : shape_(shape), narrowness_(narrowness), factor_(factor) {}

    Shape shape_ = Shape::cosine_2s;
    double narrowness_ = 0;                ///< s or beta
    double factor_ = 0.15915494309189534;  ///< 1 / integral
};

/// Returns s of the cosine-2s lobe with a given standard deviation of directions: 2/sigma^2 - 1,
/// because sigma^2 = 2 (1 - r1) with the first circular moment r1 = s/(s + 1) (Kuik, van Vledder
/// and Holthuijsen 1988).
/// \param sigma_rad  in (0, sqrt 2]
double cosine_2s_exponent(double sigma_rad);

/// Spreading models from measurements of wind seas with buoys and wave staffs: one lobe per
/// frequency.
class MeasuredSpreading {
   public:
    /// \param model  not `paper`
    /// \param peak_radps  peak frequency of the wind sea's spectrum, rad/s
    /// \param inverse_wave_age  U/c, wind speed over the phase speed at the peak; clamped to the
    /// range [0.83, 5] of Donelan et
    ///     al. 1985, where 0.83 is a fully developed sea
    MeasuredSpreading(SpreadingModel model, double peak_radps, double inverse_wave_age);

    /// Returns the lobe at `omega` rad/s.
    DirectionalLobe at(double omega) const;

   private:
    SpreadingModel model_;
    double peak_radps_;
    double inverse_wave_age_;
    double largest_s_;  ///< s of Mitsuyasu's model at the peak
};

}  // namespace pelagic
