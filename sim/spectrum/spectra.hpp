// The spectrum of a sea: energy density over wave vectors.
//
// It is the sum of the wave systems, each a density over wave number (system_spectrum.hpp) times a
// directional distribution:
//   S(kx, kz) = S(k) / k D(theta), in m^4.
// The integral of S(kx, kz) over all k is the variance, and
// E|h0(k)|^2 = S dk^2 / 2 on a grid with spacing dk = 2 pi / L. If the waves exceed the height limit
// of the depth, breaking reduces all energies by one factor.
// `phillips-paper` keeps the paper's own scaling, which depends on N and L and has no physical
// height.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/spreading.hpp"
#include "pelagic/sim/spectrum/system_spectrum.hpp"

namespace pelagic {

/// Largest significant wave height over depth: Hrms = 0.42 d, so Hs = 0.6 d, on a beach where every
/// incoming wave breaks (Thornton and Guza 1982).
inline constexpr double highest_over_depth = 0.6;

/// Wave numbers of numerical integrations and searches, rad/m: from ten times the longest wind wave
/// to a tenth of a millimetre, 2 % apart.
inline constexpr double min_scanned_k = 1e-5, max_scanned_k = 6e4, scanned_k_ratio = 1.02;

/// Largest number of systems of a sea: the wind sea, the swell and SeaState::systems.
inline constexpr std::size_t max_spectra = 2 + max_wave_systems;

/// The spectrum of one sea on the grid of one of its cascades. The constructor does the expensive
/// computation. Member functions are const and thread-safe.
class WaveSpectrum {
   public:
    /// \pre check(sea) is empty
    WaveSpectrum(const SeaState& sea, const CascadePlan& cascade);

    /// Returns E|h0(k)|^2 in m^2 at the wave vector (kx, kz) in rad/m. \pre k is not 0
    double amplitude_variance(double kx, double kz) const;

    /// Values that all waves of one wave number share, and that take most of the computation:
    /// E|h0(k)|^2 is the sum over the systems of variance * spreading.
    struct Shell {
        struct OfSystem {
            double variance;  ///< m^2 rad
            DirectionalLobe lobe;
        };
        double k;                  ///< rad/m
        double papers_cutoff = 1;  ///< of phillips-paper
        std::size_t count = 0;     ///< of systems
        std::array<OfSystem, max_spectra> systems;
    };
    /// Returns the shared values of wave number k in rad/m. \pre k is not 0
    /// \param widening  widening of directions by a cell (cell_variances()), in steps^2 of the grid
    Shell shell(double k, double widening = 0) const;
    /// Returns amplitude_variance() of (kx, kz) and of (-kx, -kz), bit-identical. \pre `shell` is
    /// shell(|(kx, kz)|)
    OppositeDensities amplitude_variances(const Shell& shell, double kx, double kz) const;
    /// Returns the contribution of a system, as a number in systems(). \pre is_physical()
    OppositeDensities amplitude_variances(const Shell& shell, std::size_t system, double kx, double kz) const;

    /// Returns the systems: the wind sea, the swell and SeaState::systems, in this order, without
    /// those that the sea does not have. Empty for phillips-paper.
    const std::vector<SystemSpectrum>& systems() const { return systems_; }
    /// Returns the energy density of a system over wave number, m^3.
    double radial_density(std::size_t system, double k) const;
    /// Returns the smallest standard deviation of a shell's lobes among those that are given; 10 if
    /// none is.
    double narrowest_lobe_rad() const;

    /// Returns the energy density over wave number, integrated over all directions, m^3. Its
    /// integral over k is the variance.
    /// \pre is_physical()
    double radial_density(double k) const;
    /// Returns the integral of radial_density() over all k, m^2. \pre is_physical()
    double variance() const;

    /// Returns the fraction of the energy that remains after breaking. It is less than 1 if
    /// the systems without breaking would have a significant wave height over highest_over_depth
    /// times the depth.
    double kept_after_breaking() const { return kept_; }

    /// Returns the lean of waves of wave number k in rad/m: lean_of() times the wind sea's
    /// fraction of their energy, because a swell is symmetric.
    double lean(double k) const;

    const Water& water() const { return water_; }

    /// Returns false for phillips-paper.
    bool is_physical() const { return !papers_; }

   private:
    /// phillips-paper: E|h0|^2 = scale exp(-1/(k L)^2) / k^4 times spreading and cutoff.
    struct Papers {
        double scale;           ///< A of VR Ocean, equation 4
        double largest_wave_m;  ///< L = V^2 / g of equation 3
        double cutoff_m;        ///< l of equation 10
        double wind_x, wind_z;
        PaperSpreading spreading;
    };
    static Papers papers_of(const SeaState& sea, const CascadePlan& cascade);

    Water water_;
    double grid_spacing_;  ///< dk in rad/m
    std::optional<Papers> papers_;
    std::vector<SystemSpectrum> systems_;
    /// Whether lobes are narrower by what cells add. The cells of a stack around the peak of its wind
    /// are small: they add 0.0004 rad^2, 0.3 % of the spread of a swell.
    bool narrows_;
    double lean_;  ///< lean_of(sea)
    double kept_ = 1;
};

}  // namespace pelagic
