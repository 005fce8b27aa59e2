#include "pelagic/sim/spectrum/system_report.hpp"

#include <algorithm>
#include <cmath>

#include "pelagic/message/number_text.hpp"
#include "pelagic/sim/spectrum/spectral_peak.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"

namespace pelagic {
namespace {

// Directions of half a circle in the integral of cos(theta) D(theta).
constexpr int directions_of_half = 180;
// Waves with less of the energy in a step of the integral have no share in the spread.
constexpr double least_share = 1e-7;

/// Returns the first circular moment of a lobe around its direction.
double first_moment(const SystemSpectrum& system, const DirectionalLobe& lobe) {
    double moment = 0, all = 0;
    for (int i = 0; i < directions_of_half; ++i) {
        const double turns = (i + 0.5) / (2 * directions_of_half);
        const auto from_axis = det::sine_cosine_of_turns(turns - 0.25);
        const auto both = system.spread_around(lobe, from_axis.cosine);
        moment += (both.along - both.against) * from_axis.cosine;
        all += both.along + both.against;
    }
    return moment / all;
}

/// Returns "NAME value UNIT instead of given UNIT".
std::string instead(const char* name, double value, double given, const char* unit) {
    return std::string(name) + " " + rounded_text(value, 4) + unit + " instead of " + rounded_text(given, 4) + unit;
}

}  // namespace

ModelOfSystem model_of_system(const WaveSpectrum& spectrum, std::size_t number) {
    const SystemSpectrum& system = spectrum.systems()[number];
    const double step = det::log(scanned_k_ratio);
    double m0 = 0, m2 = 0, aligned = 0, moment = 0, with_moment = 0;
    for (double k = min_scanned_k; k < max_scanned_k; k *= scanned_k_ratio) {
        const ShellOfWaves shell(k, spectrum.water());
        const double energy = spectrum.radial_density(number, k) * k * step;
        m0 += energy;
        m2 += energy * shell.omega * shell.omega;
        if (!(energy > least_share * m0)) continue;
        if (system.spread_varies() || !(with_moment > 0)) moment = first_moment(system, system.lobe(shell.omega, 0));
        aligned += energy * moment;
        with_moment += energy;
    }
    const double r1 = with_moment > 0 ? aligned / with_moment : 1;
    const auto density = [&](double k) { return spectrum.radial_density(number, k); };
    return {
        .peak_radps = system.is_at_depth() ? system.peak_radps() : peak_of(spectrum.water().depth_m, density).omega,
        .variance = m0,
        .tm02_s = m2 > 0 ? two_pi * std::sqrt(m0 / m2) : 0,
        .spread_rad = std::sqrt(2 * std::max(0.0, 1 - r1)),
        .towards_rad = system.towards_rad(),
        .is_given = system.is_at_depth()};
}

std::string deviation_of(const SystemReport& held, double tm02_s, const ModelOfSystem& given) {
    if (!given.is_given) return {};
    constexpr double per_degree = two_pi / 360;
    const double height = 4 * std::sqrt(given.variance);
    double turned = (held.expected_directions.mean_rad - given.towards_rad) / two_pi;
    turned = two_pi * (turned - std::floor(turned + 0.5));
    std::string text;
    const auto add = [&](bool differs, const std::string& words) {
        if (differs) text += (text.empty() ? "" : ", ") + words;
    };
    const auto is_off = [](double value, double wanted, double share) {
        return !(std::fabs(value - wanted) <= share * wanted);
    };
    add(is_off(held.significant_wave_height_m, height, 0.005),
        instead("Hs", held.significant_wave_height_m, height, " m"));
    add(is_off(tm02_s, given.tm02_s, 0.005), instead("Tm02", tm02_s, given.tm02_s, " s"));
    add(!(std::fabs(turned) <= 0.5 * per_degree),
        instead("direction", (given.towards_rad + turned) / per_degree, given.towards_rad / per_degree, " degrees"));
    add(is_off(held.expected_directions.spread_rad, given.spread_rad, 0.01),
        instead("spread", held.expected_directions.spread_rad / per_degree, given.spread_rad / per_degree,
                " degrees"));
    return text;
}

}  // namespace pelagic
