// The wave spectra: energy density over wave vectors.
//
// A physical model is a deep-water frequency spectrum S(omega) in m^2 s times Kitaigorodskii's
// factor, which is less than 1 in finite depth (TMA: Bouws et al. 1985). It is multiplied by a
// directional distribution and transformed to wave vectors:
//   S(kx, kz) = S(omega) phi(omega, depth) (d omega / d k) / k D(theta), in m^4.
// The integral of S(kx, kz) over all k is the variance, and
// E|h0(k)|^2 = S dk^2 / 2 on a grid with spacing dk = 2 pi / L. A swell adds its own energy. If
// the waves exceed the height limit of the depth, breaking reduces all energies by one factor.
// `phillips-paper` keeps the paper's own scaling, which depends on N and L and has no physical
// height.
#pragma once

#include <optional>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/spreading.hpp"

namespace pelagic {

/// Largest significant wave height over depth: Hrms = 0.42 d, so Hs = 0.6 d, on a beach where every
/// incoming wave breaks (Thornton and Guza 1982).
inline constexpr double highest_over_depth = 0.6;

/// Dimensionless fetch g F / U10^2 of a fully developed sea. JONSWAP's laws have no such limit
/// (Hasselmann et al. 1973). At this fetch their peak frequency equals that of Pierson and
/// Moskowitz 1964, 0.877 g / U19.5 = 0.855 g / U10, and Hs is 0.285 U10^2 / g.
inline constexpr double full_development = 17000;

/// Wave numbers of numerical integrations and searches, rad/m: from ten times the longest wind wave
/// to a tenth of a millimetre, 2 % apart.
inline constexpr double min_scanned_k = 1e-5, max_scanned_k = 6e4, scanned_k_ratio = 1.02;

/// Returns the fetch that `jonswap` uses, metres: fetch_m, at most full_development U^2 / g.
double effective_fetch_m(const SeaState& sea);

/// The spectrum of one sea on the grid of one of its cascades. The constructor does the expensive
/// computation. Member functions are const and thread-safe.
class WaveSpectrum {
   public:
    /// \pre check(sea) is empty
    WaveSpectrum(const SeaState& sea, const CascadePlan& cascade);

    /// Returns E|h0(k)|^2 in m^2 at the wave vector (kx, kz) in rad/m. \pre k is not 0
    double amplitude_variance(double kx, double kz) const;

    /// Values that all waves of one wave number share, and that take most of the computation:
    /// E|h0(k)|^2 = before * spreading * after + swell * spreading of the swell.
    struct Shell {
        double k;  ///< rad/m
        double before, after;
        double swell;
        DirectionalLobe lobe;  ///< lobe of the wind sea; unused for spreading `paper`
    };
    /// Returns the shared values of wave number k in rad/m. \pre k is not 0
    Shell shell(double k) const;
    /// Returns amplitude_variance() of (kx, kz) and of (-kx, -kz), bit-identical. \pre `shell` is
    /// shell(|(kx, kz)|)
    OppositeDensities amplitude_variances(const Shell& shell, double kx, double kz) const;

    /// Returns the energy density over wave number, integrated over all directions, m^3. Its
    /// integral over k is the variance.
    /// \pre is_physical()
    double radial_density(double k) const;
    /// Returns the integral of radial_density() over all k, m^2. \pre is_physical()
    double variance() const;

    /// Returns the fraction of the energy that remains after breaking. It is less than 1 if wind
    /// sea and swell without breaking would have a significant wave height over highest_over_depth
    /// times the depth.
    double kept_after_breaking() const { return kept_; }

    /// Returns the lean of waves of wave number k in rad/m: lean_of() times the wind sea's
    /// fraction of their energy, because a swell is symmetric.
    double lean(double k) const;

    const Water& water() const { return water_; }

    /// Returns false for phillips-paper.
    bool is_physical() const { return sea_.spectrum != SpectrumModel::phillips_paper; }

   private:
    double wind_density(double k) const;   // wind sea's contribution to radial_density()
    double swell_density(double k) const;  // swell's contribution to radial_density()
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
    double peak_;      // peak frequency of the wind sea in deep water, rad/s
    double cutoff_m_;  // l of equation 10
    std::optional<MeasuredSpreading> measured_spreading_;
    double lean_;            // lean_of(sea)
    double swell_variance_;  // m^2
    double swell_peak_;      // rad/s
    double swell_x_, swell_z_;
    DirectionalLobe swell_lobe_;
    double kept_ = 1;
};

}  // namespace pelagic
