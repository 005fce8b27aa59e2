// The waves of a cascade: their expected energies and their random amplitudes for a seed. The
// waves of an analytic sea are listed, not random, so their amplitudes equal the expected values.
#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <optional>
#include <vector>

#include "pelagic/sim/cascade_plan.hpp"
#include "pelagic/sim/sea_state.hpp"
#include "pelagic/sim/spectrum/spectra.hpp"
#include "pelagic/sim/spectrum/wave_list.hpp"

namespace pelagic {

/// A wave of the grid.
struct Wave {
    std::complex<double> amplitude;  ///< h0, metres
    double variance = 0;             ///< E|h0|^2, m^2
};

/// The waves of k and -k.
struct OppositeWaves {
    Wave along, against;

    double expected_square() const { return along.variance + against.variance; }
    double realised_square() const { return std::norm(along.amplitude) + std::norm(against.amplitude); }
};

/// The waves of a cascade. Member functions are const and thread-safe.
class CascadeWaves {
   public:
    /// \pre check(sea) is empty; `cascade` is one of plan_cascades(sea)
    CascadeWaves(const SeaState& sea, const CascadePlan& cascade);

    const CascadePlan& cascade() const { return cascade_; }
    /// \pre sea.waves is spectrum
    const WaveSpectrum& spectrum() const { return *spectrum_; }
    /// Returns depth and surface tension for the dispersion relation.
    const Water& water() const { return spectrum_ ? spectrum_->water() : listed_water_; }
    /// Returns the frequency of a wave number, in rad/s. The second harmonic of a regular wave is bound
    /// to it: its frequency is twice that of the wave. \pre k > 0
    double frequency(double k) const {
        return regular_ && k > 1.5 * regular_->k ? 2 * regular_->omega : angular_frequency(k, water());
    }

    /// Returns the lean of waves of wave number k in rad/m, 0 for listed waves.
    double lean(double k) const { return spectrum_ ? spectrum_->lean(k) : 0; }

    /// Returns whether (m, n) is a wave. DC (VR Ocean, equation 14) and the Nyquist row and column
    /// hold no waves: N/2 and -N/2 are one grid index, so the direction of propagation is
    /// ambiguous.
    bool holds(int m, int n) const {
        const int nyquist = cascade_.resolution / 2;
        return (m != 0 || n != 0) && m != -nyquist && n != -nyquist;
    }

    /// The waves (m, n) and (-m, n) with their opposites. They share a wave number and therefore
    /// most of the computation.
    struct MirroredPair {
        OppositeWaves plus, minus;
    };
    /// Returns the waves of (m, n) and (-m, n). \pre holds(m, n) and holds(-m, n)
    MirroredPair pair(int m, int n) const;

    /// E|h0|^2 of (m, n) and (-m, -n), and of (-m, n) and (m, -n), m^2.
    struct MirroredVariances {
        OppositeDensities plus, minus;
    };
    /// Returns the variances of pair(), at lower cost. \pre holds(m, n) and holds(-m, n)
    MirroredVariances variances(int m, int n) const;

    /// Variances of a wave for each of WaveSpectrum::systems(); the others are 0.
    using VariancesBySystem = std::array<MirroredVariances, max_spectra>;
    /// Returns the contribution of each system to variances(). \pre as of variances(), and sea.waves
    /// is spectrum, but not phillips-paper
    VariancesBySystem variances_by_system(int m, int n) const;

    /// Returns |h0|^2 of the wave (m, n) for this seed, m^2, at lower cost than the wave itself.
    /// \param variance  E|h0|^2 of the wave, m^2
    double realised_square(double variance, int m, int n) const;

    /// Returns h0 of the wave (m, n), metres (VR Ocean, equation 13); 0 if the cascade holds no
    /// such wave.
    std::complex<double> amplitude(int m, int n) const;

   private:
    struct ShellOfPoint;
    template <class Add>
    double for_points_of_cell(int m, int n, const Add& add) const;
    MirroredVariances point_variances(double m, double n, double widening) const;
    int points_across(double steps, bool is_cut) const;
    Wave realised(double variance, int m, int n) const;
    Wave listed(int m, int n) const;

    std::uint32_t seed_;
    CascadePlan cascade_;
    std::optional<WaveSpectrum> spectrum_;  ///< if empty, list_ holds all waves
    std::vector<GridWave> list_;            ///< sorted by grid index
    double narrowest_rad_ = 0;              ///< of spectrum_
    Water listed_water_ = deep_water;       ///< of the listed waves
    std::optional<StokesWave> regular_;     ///< of a regular sea
};

}  // namespace pelagic
