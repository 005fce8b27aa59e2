// The spectrum of one wave system: an energy density over wave number times a directional spreading.
//
// A system by a wind is a deep-water frequency spectrum S(omega) in m^2 s times Kitaigorodskii's
// factor, which is less than 1 in finite depth (TMA: Bouws et al. 1985). A swell, and a system by
// height or period, is a frequency spectrum at the sea's depth, without that factor. Its height and
// its peak are therefore exact at any depth. Both are transformed to wave numbers by d omega / d k.
#pragma once

#include <optional>

#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/sim/spectrum/spreading.hpp"

namespace pelagic {

/// Dimensionless fetch g F / U10^2 of a fully developed sea. JONSWAP's laws have no such limit
/// (Hasselmann et al. 1973). At this fetch their peak frequency equals that of Pierson and
/// Moskowitz 1964, 0.877 g / U19.5 = 0.855 g / U10, and Hs is 0.285 U10^2 / g.
inline constexpr double full_development = 17000;

/// Returns the fetch that `jonswap` uses, metres: fetch_m, at most full_development U^2 / g.
double effective_fetch_m(const SeaState& sea);

/// Returns the wind sea of a sea's own options as a system. \pre sea.spectrum is not none
WaveSystem wind_sea_of(const SeaState& sea);

/// Returns whether some waves of a sea are given by more than wind and swell: cascades hold the peak
/// and the tail of each of its systems. \pre sea.waves is spectrum
inline bool has_given_systems(const SeaState& sea) {
    return sea.wave_height_m > 0 || sea.peak_period_s > 0 || !sea.systems.empty();
}

/// Returns whether height or period of a system are given, instead of following from the wind.
inline bool is_by_height(const WaveSystem& system) { return system.height_m > 0 || system.peak_period_s > 0; }

/// A wave number with the values that all systems share.
struct ShellOfWaves {
    double k;               ///< rad/m
    double omega;           ///< rad/s
    double group_velocity;  ///< m/s
    ShellOfWaves(double wave_number, const Water& water)
        : k(wave_number), omega(angular_frequency(k, water)), group_velocity(pelagic::group_velocity(k, water)) {}
};

/// Member functions are const and thread-safe.
class SystemSpectrum {
   public:
    /// \param system  not of phillips-paper or none
    /// \param sea  for depth, short_wave_cutoff and wind_alignment
    SystemSpectrum(const WaveSystem& system, const SeaState& sea);
    /// Returns the swell of a sea.
    static SystemSpectrum swell(const SeaState& sea);

    /// Returns the energy density over wave number before breaking, integrated over all directions,
    /// m^3.
    double density(const ShellOfWaves& shell) const;
    /// Returns an upper bound of the integral of density() over all k, m^2, in closed form.
    double largest_variance() const;

    /// Returns the lobe of waves of omega rad/s, unless the spreading is `paper`.
    /// \param widening  variance of directions, rad^2, that cells add: the lobe is narrower by it
    DirectionalLobe lobe(double omega, double widening) const;
    /// Returns the densities over direction, 1/rad, of the wave vector (kx, kz) and of its opposite.
    /// \param k  |(kx, kz)|
    OppositeDensities spread(const DirectionalLobe& lobe, double kx, double kz, double k) const {
        return spread_around(lobe, (kx * towards_x_ + kz * towards_z_) / k);
    }
    /// As spread(), for the cosine of the angle between wave and system.
    OppositeDensities spread_around(const DirectionalLobe& lobe, double cosine) const {
        return paper_ ? paper_->densities(cosine) : lobe.densities(cosine);
    }
    /// Returns whether the lobe depends on the frequency.
    bool spread_varies() const { return measured_.has_value(); }

    /// Returns the standard deviation of directions where it is given, else 0.
    double given_spread_rad() const { return given_spread_rad_; }
    double towards_rad() const { return towards_rad_; }
    /// Returns whether height and peak are those of the sea's depth: of a swell, and of a system by
    /// height or period.
    bool is_at_depth() const { return is_at_depth_; }
    /// Returns the peak of the spectrum in rad/s; of a system by a wind, that in deep water.
    double peak_radps() const { return peak_; }

   private:
    enum class Shape { phillips, pierson_moskowitz, jonswap, ochi_hubble };
    SystemSpectrum(Shape shape, double direction_rad, double spread_rad);

    double frequency_density(double omega) const;
    double short_wave_factor(double k) const;

    Shape shape_;
    bool is_at_depth_ = false;  ///< without Kitaigorodskii's factor
    double depth_m_ = 0;
    double peak_ = 0;   ///< rad/s
    double alpha_ = 0;  ///< of jonswap
    double gamma_ = 1;
    double wind_frequency_ = 0;  ///< g / U, rad/s
    double largest_wave_m_ = 0;  ///< L = V^2 / g of VR Ocean, equation 3
    double cutoff_m_ = 0;        ///< l of VR Ocean, equation 10
    double variance_ = 0;        ///< of ochi_hubble, m^2
    double towards_rad_, towards_x_, towards_z_;
    double given_spread_rad_;
    DirectionalLobe given_lobe_;
    std::optional<MeasuredSpreading> measured_;
    std::optional<PaperSpreading> paper_;
};

/// Returns l = l_min (l_max / l_min)^beta with l_max = 1/(2 k_p). In VR Ocean, equation 11, l_max is
/// a quarter of the patch (errata). At beta = 1, a wave of a quarter of the peak wavelength keeps a
/// fraction exp(-4) of its energy, and a wave of the peak wavelength keeps 0.78.
/// \param peak  rad/s, in deep water
double cutoff_length_m(const SeaState& sea, double peak);
/// Returns the factor of VR Ocean, equation 10.
double short_wave_factor(double k, double cutoff_m);
/// Returns the peak of phillips' shape in deep water, rad/s: that of the spectrum integrated over all
/// directions.
double phillips_peak(double wind_speed_mps);

}  // namespace pelagic
