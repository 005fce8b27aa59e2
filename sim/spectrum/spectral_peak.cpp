#include "pelagic/sim/spectrum/spectral_peak.hpp"

#include "pelagic/sim/spectrum/dispersion.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {

double radial_energy(const WaveSpectrum& spectrum, const SeaState& sea, double k) {
    if (spectrum.is_physical()) return spectrum.radial_density(k);
    // The paper's spreading does not depend on k, so the spectrum along the wind has the shape of
    // the integral.
    const auto wind = det::sine_cosine_of_turns(sea.wind_direction_rad / two_pi);
    return k * spectrum.amplitude_variance(k * wind.cosine, k * wind.sine);
}

// Finds the maximum on a coarse grid and refines it with halved steps.
SpectralPeak peak_of(double depth_m, const std::function<double(double)>& density_of_k) {
    const auto density = [&](double k) { return density_of_k(k) / group_velocity(k, depth_m); };
    double best = min_scanned_k, max = density(best);
    const auto try_out = [&](double k) {
        const double here = density(k);
        if (!(here > max)) return;
        best = k;
        max = here;
    };
    for (double k = min_scanned_k; k < max_scanned_k; k *= scanned_k_ratio) try_out(k);
    for (double step = scanned_k_ratio - 1; step > 1e-7; step *= 0.5)
        for (const double k : {best * (1 - step), best * (1 + step)}) try_out(k);
    return {best, angular_frequency(best, depth_m)};
}

SpectralPeak peak_of(const WaveSpectrum& spectrum, const SeaState& sea) {
    return peak_of(sea.depth_m, [&](double k) { return radial_energy(spectrum, sea, k); });
}

}  // namespace pelagic
