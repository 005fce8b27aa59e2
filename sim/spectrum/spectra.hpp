// The wave spectra: how much energy each wave vector holds.
//
// Physical models are a frequency spectrum S(omega) in m^2 s, spread over directions and carried to wave vectors:
//   S(kx, kz) = S(omega) (d omega / d k) / k D(theta), in m^4, so that the integral over all k is the variance
// and E|h0(k)|^2 = S dk^2 / 2 on a grid with spacing dk = 2 pi / L. `phillips-paper` keeps the paper's own scaling,
// which depends on N and L and has no physical height.
#pragma once

#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/spectrum/spreading.hpp"
#include "pelagic/sim/tile_plan.hpp"

namespace pelagic {

/// The spectrum of one sea on the lattice of one of its tiles. Construction does the slow part; calls are const and thread-safe.
class WaveSpectrum {
   public:
    /// \pre check(sea) is empty
    WaveSpectrum(const SeaState& sea, const TilePlan& tile);

    /// E|h0(k)|^2 in m^2 at the wave vector (kx, kz) in rad/m of the tile's lattice. \pre k is not 0
    double amplitude_variance(double kx, double kz) const;

    /// What all waves of one wave number share, which is most of the work: E|h0(k)|^2 = before * spreading * after.
    struct Shell {
        double k;  ///< rad/m
        double before, after;
    };
    /// \pre k is not 0
    Shell shell(double k) const;
    /// amplitude_variance() of (kx, kz) and of (-kx, -kz), the same bits. \pre the shell is that of their length
    DirectionalSpreading::Opposites amplitude_variances(const Shell& shell, double kx, double kz) const;

    /// Energy over wave number, all directions together: the integral over k is the variance, m^3.
    /// \pre the model is a physical one
    double radial_density(double k) const;

    /// False for phillips-paper.
    bool is_physical() const { return sea_.spectrum != SpectrumModel::phillips_paper; }

   private:
    double frequency_density(double omega) const;
    double small_wave_cutoff(double k) const;

    SeaState sea_;
    DirectionalSpreading spreading_;
    double wind_x_, wind_z_;
    double largest_wave_m_;  // L = V^2 / g of equation 3
    double cutoff_m_;        // l of equation 11
    double grid_spacing_;    // dk in rad/m
    double paper_scale_;     // A of equation 4
    double jonswap_alpha_;
    double jonswap_peak_;  // rad/s
};

}  // namespace pelagic
