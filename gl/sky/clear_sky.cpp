#include "pelagic/gl/sky/clear_sky.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "pelagic/gl/sky/sky_mirrors.hpp"

namespace pelagic::gl {
namespace {

using std::numbers::pi_v;

/// Irradiance of the full moon above the atmosphere, relative to the sun's.
constexpr float full_moon = 1.f / 400'000;
/// Radiance of the night sky, 2e-4 cd/m^2, relative to the sun's irradiance; slightly blue, as
/// starlight is.
constexpr glm::vec3 night_radiance = glm::vec3(0.92f, 1.0f, 1.12f) * (2e-4f / sun_illuminance_lx);
/// Lowest elevation of the sun in the model. There, only the glow at the horizon remains.
constexpr float lowest_modelled_rad = -6.0f * pi_v<float> / 180;
/// The amount of light is interpolated between modelled and published values in this range of
/// elevations, degrees.
constexpr float model_alone_deg = 2, published_alone_deg = -3;
/// Lower bound of a scene's illuminance, in units. Half floats have full precision down to 6e-5.
constexpr float min_light = 1.f / 32;

float luminance(glm::vec3 colour) { return glm::dot(colour, glm::vec3(0.2126f, 0.7152f, 0.0722f)); }

/// Returns the direction to the sun of the model.
glm::vec3 modelled_sun(SkyOptions options) {
    options.sun_elevation_rad = std::max(options.sun_elevation_rad, lowest_modelled_rad);
    return sun_direction(options);
}

template <class Radiance>
glm::vec3 irradiance_of(const Radiance& radiance) {
    glm::vec3 sum(0);
    constexpr std::uint32_t samples = 256;
    for (std::uint32_t i = 0; i < samples; ++i) {
        const glm::vec2 u = hammersley(i, samples);
        const float across = std::sqrt(u.x), angle = 2 * pi_v<float> * u.y;
        sum += radiance(glm::vec3(across * std::cos(angle), std::sqrt(1 - u.x), across * std::sin(angle)));
    }
    return sum * (pi_v<float> / samples);
}

}  // namespace

double published_illuminance_lx(double elevation_deg) {
    struct Piece {
        double from_deg, l0, l1, l2, l3;  // log10 as a polynomial in the elevation over 90 degrees
    };
    constexpr Piece pieces[] = {{20, 3.74, 3.97, -4.07, 1.47},         {5, 3.05, 13.28, -45.98, 64.33},
                                {-0.8, 2.88, 22.26, -207.64, 1034.30}, {-5, 2.88, 21.81, -258.11, -858.36},
                                {-12, 2.70, 12.17, -431.69, -1899.83}, {-18, 13.84, 262.72, 1447.42, 2797.93}};
    // Below astronomical twilight, the sunlight falls by a factor of ten in two degrees.
    if (elevation_deg < -18) return published_illuminance_lx(-18) * std::pow(10, (elevation_deg + 18) / 2);
    const double x = elevation_deg / 90;
    for (const Piece& piece : pieces)
        if (elevation_deg >= piece.from_deg)
            return std::pow(10, piece.l0 + x * (piece.l1 + x * (piece.l2 + x * piece.l3)));
    return 0;
}

double moon_light(double phase_angle_rad) {
    const double degrees = std::abs(phase_angle_rad) * 180 / std::numbers::pi;
    return std::pow(10, -0.4 * (0.026 * degrees + 4e-9 * std::pow(degrees, 4)));
}

ClearSky::ClearSky(const SkyOptions& options) : ClearSky(options, Atmosphere::FillLater{}) {
    for (int line = 0; line < lines; ++line) fill_line(line);
    finish();
}

ClearSky::ClearSky(const SkyOptions& options, Atmosphere::FillLater later)
    : sun_elevation_rad_(options.sun_elevation_rad),
      sun_air_(modelled_sun(options), options.visibility_m, later),
      sun_is_up_(options.sun_elevation_rad > lowest_modelled_rad) {
    const glm::vec3 sun = sun_direction(options), moon = moon_direction(options);
    // A moon in daylight adds no visible light.
    if (moon.y <= 0 || sun.y >= 0) return;
    moon_air_.emplace(moon, options.visibility_m, later);
    const float phase_angle = std::acos(std::clamp(-glm::dot(sun, moon), -1.f, 1.f));
    moon_irradiance_ = glm::vec3(full_moon * static_cast<float>(moon_light(double{phase_angle})));
}

void ClearSky::fill_line(int line) {
    if (line < Atmosphere::lines)
        sun_air_.fill_line(line);
    else if (moon_air_)
        moon_air_->fill_line(line - Atmosphere::lines);
}

void ClearSky::finish() {
    sun_air_.finish();
    if (moon_air_) moon_air_->finish();
    const float elevation_deg = glm::degrees(sun_elevation_rad_);
    const glm::vec3 sky_light = irradiance_of([&](glm::vec3 d) { return sun_air_.radiance(d); });
    const glm::vec3 all_light =
        sky_light + sun_air_.sun_transmittance() * std::max(std::sin(sun_elevation_rad_), 0.f);
    const float published = static_cast<float>(published_illuminance_lx(double{elevation_deg})) / sun_illuminance_lx;
    const float weight = 1 - glm::smoothstep(published_alone_deg, model_alone_deg, elevation_deg);
    twilight_scale_ = std::pow(published / std::max(luminance(all_light), 1e-12f), weight);
    irradiance_ = irradiance_of([&](glm::vec3 d) { return radiance(d); });
    const float light = luminance(irradiance_ + key_light().irradiance);
    if (light < min_light) unit_ = std::exp2(std::floor(std::log2(light / min_light)));
}

glm::vec3 ClearSky::radiance(glm::vec3 direction) const {
    glm::vec3 sum = sun_air_.radiance(direction) * twilight_scale_;
    if (sun_air_.sun().y < 0) sum += night_radiance;
    if (moon_air_) sum += moon_air_->radiance(direction) * moon_irradiance_;
    return sum / unit_;
}

KeyLight ClearSky::key_light(float height_m) const {
    const glm::vec3 sunlight = sun_is_up_ ? sun_air_.sun_transmittance(height_m) * twilight_scale_ : glm::vec3(0);
    const glm::vec3 moonlight = moon_air_ ? moon_air_->sun_transmittance(height_m) * moon_irradiance_ : glm::vec3(0);
    if (moon_air_ && luminance(moonlight) > luminance(sunlight)) return {moon_air_->sun(), moonlight / unit_, true};
    return {sun_air_.sun(), sunlight / unit_, false};
}

}  // namespace pelagic::gl
