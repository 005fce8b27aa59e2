#include "pelagic/gl/exposure.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace pelagic::gl {
namespace {

constexpr float middle_grey = 0.18f;
constexpr float calibration = 12.5f / 100;  ///< K over ISO 100
constexpr float bright_fraction = 0.02f, shown_bright = 0.9f, max_protection_stops = 1.5f;
constexpr float shown_median = 0.065f, shown_quarter = 0.035f, max_brightening_stops = 1;
constexpr float darkest_cd_m2 = 1e-5f;

// shaders/film.glsl: v = y (1 + (lifted_below / y)^2)^(1/8), (v (v + a) - b) / (v (c v + d) + e).
constexpr float lifted_below = 0.25f, darkest_lifted = 1e-5f;
constexpr float film_a = 0.0245786f, film_b = 0.000090537f, film_c = 0.983729f, film_d = 0.4329510f,
                film_e = 0.238081f;

float with_lifted_shadows(float scene) {
    const float below = lifted_below / std::max(scene, darkest_lifted);
    return scene * std::pow(1 + below * below, 0.125f);
}

float key_of(float luminance_cd_m2) { return 1.03f - 2 / (2 + std::log10(luminance_cd_m2 + 1)); }

float shown_log_average(float luminance_cd_m2) {
    constexpr float sunlit_cd_m2 = 4000, darkest_key = 0.03f;
    const float sunlit_key = key_of(sunlit_cd_m2);
    const float power = std::log(darkest_key / middle_grey) / std::log(darkest_key / sunlit_key);
    return middle_grey * std::pow(std::min(1.f, key_of(luminance_cd_m2) / sunlit_key), power);
}

}  // namespace

float shown_by_film(float scene) {
    const float v = with_lifted_shadows(scene);
    return std::clamp((v * (v + film_a) - film_b) / (v * (film_c * v + film_d) + film_e), 0.f, 1.f);
}

float film_input_of(float shown) {
    const float square = 1 - film_c * shown, linear = film_a - film_d * shown;
    const float lifted =
        (-linear + std::sqrt(linear * linear + 4 * square * (film_b + film_e * shown))) / (2 * square);
    // In logarithms, the slope of with_lifted_shadows() is from 0.75 to 1: each step leaves at most
    // a quarter of the error.
    float scene = lifted;
    for (int step = 0; step < 12; ++step) scene *= lifted / with_lifted_shadows(scene);
    return scene;
}

float exposure_of_ev(float ev, float luminance_of_unit) {
    return film_input_of(middle_grey) * luminance_of_unit / (calibration * std::exp2(ev));
}

float ev_of_exposure(float exposure, float luminance_of_unit) {
    return std::log2(film_input_of(middle_grey) * luminance_of_unit / (calibration * exposure));
}

float night_darkening(float luminance_cd_m2) {
    return film_input_of(shown_log_average(luminance_cd_m2)) / film_input_of(middle_grey);
}

float metered_ev(std::span<const MeteredCell> cells, float luminance_of_unit) {
    const float min = std::log2(darkest_cd_m2 / luminance_of_unit);
    double sum = 0;
    std::vector<float> means, logarithms;
    for (const MeteredCell& cell : cells) {
        if (!std::isfinite(cell.mean_of_log2) || !std::isfinite(cell.log2_of_mean)) continue;
        logarithms.push_back(std::max(cell.mean_of_log2, min));
        sum += static_cast<double>(logarithms.back());
        means.push_back(std::max(cell.log2_of_mean, min));
    }
    const float log_average = means.empty() ? min : static_cast<float>(sum / static_cast<double>(means.size()));
    const float luminance = std::exp2(log_average) * luminance_of_unit;
    const float by_average = std::log2(night_darkening(luminance)) - log_average;
    float stops = by_average;  // exposure in stops, relative to a grey card of luminance 1
    if (!means.empty()) {
        const auto bright =
            means.begin() + static_cast<std::ptrdiff_t>(static_cast<float>(means.size() - 1) * (1 - bright_fraction));
        std::nth_element(means.begin(), bright, means.end());
        const float by_highlights = std::log2(film_input_of(shown_bright) / film_input_of(middle_grey)) - *bright;
        std::sort(logarithms.begin(), logarithms.end());
        // night_darkening() reduces these limits at night.
        const auto stops_of = [&](float fraction, float shown) {
            const float quantile =
                logarithms[static_cast<std::size_t>(fraction * static_cast<float>(logarithms.size()))];
            return std::log2(night_darkening(luminance) * film_input_of(shown) / film_input_of(middle_grey)) - quantile;
        };
        stops = std::max({std::min(by_average, by_highlights), by_average - max_protection_stops,
                          stops_of(0.5f, shown_median)});
        stops = std::clamp(stops_of(0.25f, shown_quarter), stops, stops + max_brightening_stops);
    }
    return std::clamp(std::log2(luminance_of_unit / calibration) - stops, min_ev, max_ev);
}

void FollowedExposure::follow(float metered, double passed_s) {
    if (!ev_) {
        ev_ = metered;
        return;
    }
    const double time_constant_s = metered > *ev_ ? to_brighter_s : to_darker_s;
    const auto remaining = static_cast<float>(std::exp(-std::max(passed_s, 0.0) / time_constant_s));
    *ev_ = metered + (*ev_ - metered) * remaining;
}

}  // namespace pelagic::gl
