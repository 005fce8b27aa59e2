#include "pelagic/analytic/plane_waves.hpp"

#include <array>
#include <cmath>

#include "pelagic/analytic/kernels/analytic_kernels.hpp"
#include "pelagic/analytic/wave_phase.hpp"
#include "pelagic/message/invalid_value_message.hpp"
#include "pelagic/simd/constants.hpp"
#include "pelagic/simd/det_math.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

constexpr std::array plane_wave_field_table = {
    NumericField<PlaneWave>{"amplitude_m", &PlaneWave::amplitude_m, 0, 100, "[0, 100]"},
    NumericField<PlaneWave>{"turns_per_m_x", &PlaneWave::turns_per_m_x, -200, 200, "[-200, 200]"},
    NumericField<PlaneWave>{"turns_per_m_z", &PlaneWave::turns_per_m_z, -200, 200, "[-200, 200]"},
    NumericField<PlaneWave>{"frequency_hz", &PlaneWave::frequency_hz, 0, 1e4, "[0, 1e4]"},
    NumericField<PlaneWave>{"phase_turns", &PlaneWave::phase_turns, -1, 1, "[-1, 1]"},
};

}  // namespace

double PlaneWave::turns_per_m() const {
    return std::sqrt(turns_per_m_x * turns_per_m_x + turns_per_m_z * turns_per_m_z);
}

double deep_water_frequency_hz(double turns_per_m) {
    return std::sqrt(gravity_mps2 * (two_pi * turns_per_m)) / two_pi;
}

PlaneWaves plane_waves_of(const AnalyticSea& sea) {
    const DefaultFloatEnvironment environment;
    PlaneWaves waves{.waves = {}, .choppiness = sea.choppiness};
    for (const AnalyticWave& wave : sea.waves) {
        const auto [z, x] = det::sine_cosine_of_turns(wave.direction_rad / two_pi);
        waves.waves.push_back({.amplitude_m = wave.amplitude_m,
                               .turns_per_m_x = x / wave.wavelength_m,
                               .turns_per_m_z = z / wave.wavelength_m,
                               .frequency_hz = deep_water_frequency_hz(1 / wave.wavelength_m),
                               .phase_turns = wave.phase_rad / two_pi});
    }
    return waves;
}

double steepness_of(const PlaneWaves& sea) {
    double sum = 0;
    for (const PlaneWave& wave : sea.waves) sum += two_pi * wave.turns_per_m() * wave.amplitude_m;
    return sum;
}

double significant_height_m(const PlaneWaves& sea) {
    double squares = 0;
    for (const PlaneWave& wave : sea.waves) squares += wave.amplitude_m * wave.amplitude_m;
    return 4 * std::sqrt(squares / 2);
}

std::string check(const PlaneWaves& sea) {
    if (sea.waves.empty() || sea.waves.size() > max_analytic_waves)
        return invalid_value_message("waves", sea.waves.size(),
                                     "1 to " + number_text(max_analytic_waves) + " of them");
    if (!(sea.choppiness >= 0 && sea.choppiness <= 1))
        return invalid_value_message("choppiness", sea.choppiness, "[0, 1]");
    if (!(std::fabs(sea.level_m) <= 100)) return invalid_value_message("level_m", sea.level_m, "[-100, 100]");
    for (std::size_t i = 0; i < sea.waves.size(); ++i) {
        const std::string place = "waves[" + number_text(i) + "].";
        if (const std::string reason = check_fields(sea.waves[i], plane_wave_field_table); !reason.empty())
            return one_line(place + reason);
        if (const double length = sea.waves[i].turns_per_m(); !(length >= 1e-4 && length <= 200))
            return invalid_value_message(place + "turns_per_m", length, "[0.0001, 200]");
    }
    // Scaling may exceed the limit by a rounding error.
    if (const double steepness = steepness_of(sea); !(steepness <= max_steepness * (1 + 1e-12)))
        return invalid_value_message(
            "steepness", rounded_text(steepness, 6),
            "at most " + number_text(max_steepness) + ", the sum of 2 pi amplitude_m turns_per_m");
    return {};
}

}  // namespace pelagic
