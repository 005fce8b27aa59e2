// The waves of one cascade: how much each holds in the mean, and which this seed drew. An analytic sea's stand in a list: no
// seed draws them, so that all hold just their mean.
#pragma once

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

/// Of k and of -k.
struct OppositeWaves {
    Wave along, against;

    double expected_square() const { return along.variance + against.variance; }
    double drawn_square() const { return std::norm(along.amplitude) + std::norm(against.amplitude); }
};

/// Const and thread-safe.
class CascadeWaves {
   public:
    /// \pre check(sea) is empty; `cascade` is one of plan_cascades(sea)
    CascadeWaves(const SeaState& sea, const CascadePlan& cascade);

    const CascadePlan& cascade() const { return cascade_; }
    /// \pre the sea has one
    const WaveSpectrum& spectrum() const { return *spectrum_; }
    /// What its waves run in.
    const Water& water() const { return spectrum_ ? spectrum_->water() : deep_water; }

    /// DC (VR Ocean, equation 14) and the Nyquist row and column hold no waves: the partner -k of a wave of those is itself on
    /// the grid, so it can't be told which way it runs.
    bool holds(int m, int n) const {
        const int nyquist = cascade_.resolution / 2;
        return (m != 0 || n != 0) && m != -nyquist && n != -nyquist;
    }

    /// Of the waves (m, n) and (-m, n), which share a wave number and with it most of the work.
    struct MirroredPair {
        OppositeWaves plus, minus;
    };
    /// \pre holds(m, n) and holds(-m, n)
    MirroredPair pair(int m, int n) const;

    /// E|h0|^2 of (m, n) and (-m, -n), and of (-m, n) and (m, -n), m^2; what pair() holds in the mean, for less. \pre as above
    struct MirroredVariances {
        OppositeDensities plus, minus;
    };
    MirroredVariances variances(int m, int n) const;

    /// |h0|^2 of the wave (m, n) that this seed drew, m^2, where E|h0|^2 is `variance`; for less than the wave itself.
    double drawn_square(double variance, int m, int n) const;

    /// h0 of the wave numbers (m, n), metres (VR Ocean, equation 13); 0 where the cascade holds no wave.
    std::complex<double> amplitude(int m, int n) const;

   private:
    MirroredVariances point_variances(double m, double n) const;
    MirroredVariances cell_variances(int m, int n) const;
    Wave drawn(double variance, int m, int n) const;
    Wave listed(int m, int n) const;

    std::uint32_t seed_;
    CascadePlan cascade_;
    std::optional<WaveSpectrum> spectrum_;  ///< none: the list has all waves
    std::vector<GridWave> list_;            ///< by place
};

}  // namespace pelagic
