// How wave energy spreads around the wind: a power of the cosine, weaker against the wind.
#pragma once

namespace pelagic {

/// D(theta) = |cos theta|^s, s = 1 + 5 alpha^2, times sigma(alpha) = 0.01 + 0.49 (1 - alpha)^2 for waves that run
/// against the wind (VR Ocean, equations 6 to 9; the paper has no constant in front of it).
class DirectionalSpreading {
   public:
    /// \param alignment  alpha in [0, 1]
    explicit DirectionalSpreading(double alignment);

    /// The paper's value. \param cosine of the angle between the wave and the wind
    double weight(double cosine) const;

    /// Values of a wave and of the one that runs against it.
    struct Opposites {
        double along, against;
    };
    /// weight() of the cosine and of its negative, the same bits for half the work.
    Opposites weights(double cosine) const;

    /// weight() divided by its integral over all directions, 1/rad, so that it moves energy without adding any.
    double density(double cosine) const { return weight(cosine) / integral_; }
    Opposites densities(double cosine) const {
        const Opposites both = weights(cosine);
        return {both.along / integral_, both.against / integral_};
    }

   private:
    double exponent_;
    double opposing_;
    double integral_;
};

}  // namespace pelagic
