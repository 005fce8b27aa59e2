// The wave spectra: how much energy each wave vector holds.
//
// Physical models are a frequency spectrum S(omega) in m^2 s of deep water, times Kitaigorodskii's factor where the depth is
// felt (TMA: Bouws et al. 1985), spread over directions and carried to wave vectors:
//   S(kx, kz) = S(omega) phi(omega, depth) (d omega / d k) / k D(theta), in m^4; the integral over all k is the variance
// and E|h0(k)|^2 = S dk^2 / 2 on a grid with spacing dk = 2 pi / L. A swell adds its own energy. Higher waves than a depth
// bears break: then all energy is lower by one factor. `phillips-paper` keeps the paper's own scaling, which depends on N and
// L and has no physical height.
#pragma once

#include <optional>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/spreading.hpp"

namespace pelagic {

/// Largest significant wave height over depth: Hrms = 0.42 d, so Hs = 0.6 d, on a beach where every wave that comes in
/// breaks (Thornton and Guza 1982).
inline constexpr double highest_over_depth = 0.6;

/// g F / U10^2 of a fully developed sea. JONSWAP's laws know no limit (Hasselmann et al. 1973). At this fetch their peak frequency is that
/// of Pierson and Moskowitz 1964, 0.877 g / U19.5 = 0.855 g / U10, and Hs is 0.285 U10^2 / g.
inline constexpr double full_development = 17000;

/// The fetch that counts for `jonswap`, metres: fetch_m, at most full_development U^2 / g.
double effective_fetch_m(const SeaState& sea);

/// The spectrum of one sea on the grid of one of its cascades. Construction does the slow part; calls are const and thread-safe.
class WaveSpectrum {
   public:
    /// \pre check(sea) is empty
    WaveSpectrum(const SeaState& sea, const CascadePlan& cascade);

    /// E|h0(k)|^2 in m^2 at the wave vector (kx, kz) in rad/m of the cascade's grid. \pre k is not 0
    double amplitude_variance(double kx, double kz) const;

    /// What all waves of one wave number share, which is most of the work:
    /// E|h0(k)|^2 = before * spreading * after + swell * spreading of the swell.
    struct Shell {
        double k;  ///< rad/m
        double before, after;
        double swell;
        DirectionalLobe lobe;  ///< of the wind's waves, but for spreading `paper`
    };
    /// \pre k is not 0
    Shell shell(double k) const;
    /// amplitude_variance() of (kx, kz) and of (-kx, -kz), the same bits. \pre the shell is that of their length
    OppositeDensities amplitude_variances(const Shell& shell, double kx, double kz) const;

    /// Energy over wave number, all directions together: the integral over k is the variance, m^3.
    /// \pre the model is a physical one
    double radial_density(double k) const;
    /// That integral, m^2.
    double variance() const;

    /// The part of the energy that breaking leaves: less than 1 where the waves that wind and swell would make are higher than
    /// highest_over_depth of the depth.
    double kept_after_breaking() const { return kept_; }

    const Water& water() const { return water_; }

    /// False for phillips-paper.
    bool is_physical() const { return sea_.spectrum != SpectrumModel::phillips_paper; }

   private:
    double wind_density(double k) const;   // of radial_density(): the wind's part,
    double swell_density(double k) const;  // and the swell's
    double frequency_density(double omega) const;
    double small_wave_cutoff(double k) const;
    double largest_variance() const;

    SeaState sea_;
    Water water_;
    PaperSpreading paper_spreading_;
    double wind_x_, wind_z_;
    double largest_wave_m_;  // L = V^2 / g of equation 3
    double grid_spacing_;    // dk in rad/m
    double paper_scale_;     // A of equation 4
    double jonswap_alpha_;
    double peak_;      // of the wind's waves in deep water, rad/s
    double cutoff_m_;  // l of equation 10
    std::optional<MeasuredSpreading> measured_spreading_;
    double swell_variance_;  // m^2
    double swell_peak_;      // rad/s
    double swell_x_, swell_z_;
    DirectionalLobe swell_lobe_;
    double kept_ = 1;
};

}  // namespace pelagic
