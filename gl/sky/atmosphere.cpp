#include "pelagic/gl/sky/atmosphere.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <numbers>

namespace pelagic::gl {
namespace {

using std::numbers::pi_v;

constexpr int elevations = Atmosphere::lines, azimuths = 33;
constexpr int view_samples = 40;

/// Returns the distance from a point at `height_m` to the sphere at `top_m` above the sea.
/// \param cosine  cosine of the direction's angle from the zenith
float distance_to_height(float height_m, float cosine, float top_m) {
    // In double precision: the square of the earth's radius exceeds the precision of a float.
    const double r = double{earth_radius_m} + height_m, top = double{earth_radius_m} + top_m;
    const double b = r * cosine;
    return static_cast<float>(-b + std::sqrt(std::max(0.0, b * b - r * r + top * top)));
}

float height_at(float height_m, float cosine, float distance_m) {
    const double r = double{earth_radius_m} + height_m, d = distance_m;
    return static_cast<float>(std::sqrt(r * r + d * d + 2 * r * d * cosine) - earth_radius_m);
}

/// Returns the ozone concentration relative to its maximum, [0, 1].
float relative_ozone(float height_m) {
    return std::max(0.f, 1 - std::abs(height_m - ozone_height_m) / ozone_reach_m);
}

}  // namespace

float haze_per_m(float visibility_m) { return std::max(2e-6f, 3.912f / visibility_m - rayleigh_per_m.y); }

float mie_phase(float cosine, float g) {
    const float g2 = g * g;
    return 3 / (8 * pi_v<float>) * (1 - g2) * (1 + cosine * cosine) /
           ((2 + g2) * std::pow(std::max(1e-4f, 1 + g2 - 2 * g * cosine), 1.5f));
}

float rayleigh_phase(float cosine) { return 3 / (16 * pi_v<float>) * (1 + cosine * cosine); }

Atmosphere::Atmosphere(glm::vec3 sun, float visibility_m) : Atmosphere(sun, visibility_m, FillLater{}) {
    for (int line = 0; line < lines; ++line) fill_line(line);
    finish();
}

Atmosphere::Atmosphere(glm::vec3 sun, float visibility_m, FillLater)
    : sun_(sun), haze_per_m_(haze_per_m(visibility_m)), table_(elevations * azimuths) {}

glm::vec3 Atmosphere::optical_depth(float height_m, float cosine) const {
    const float length = distance_to_height(height_m, cosine, atmosphere_top_m);
    glm::vec3 depth(0);
    float before = 0;
    // A ray towards a sun below the horizon passes close to the earth and meets the densest air in
    // its middle.
    const int sun_samples = cosine < 0.05f ? 32 : 12;
    for (int i = 1; i <= sun_samples; ++i) {
        // Steps grow with distance, because the densest air is near.
        const float fraction = static_cast<float>(i) / static_cast<float>(sun_samples);
        const float end = length * fraction * fraction;
        const float h = std::max(0.f, height_at(height_m, cosine, (before + end) / 2));
        depth += (rayleigh_per_m * std::exp(-h / rayleigh_height_m) + haze_per_m_ * std::exp(-h / mie_height_m) +
                  ozone_per_m * relative_ozone(h)) *
                 (end - before);
        before = end;
    }
    return depth;
}

glm::vec3 Atmosphere::sun_transmittance(float height_m) const {
    // The earth's shadow has a soft edge of the sun's angular width: 0.27 degrees to either side.
    const float r = earth_radius_m;
    const float horizon = -std::sqrt(std::max(0.f, 1 - (r / (r + height_m)) * (r / (r + height_m))));
    const float lit = glm::clamp((sun_.y - horizon) / 0.0094f + 0.5f, 0.f, 1.f);
    return lit > 0 ? lit * glm::exp(-optical_depth(height_m, sun_.y)) : glm::vec3(0);
}

glm::vec3 Atmosphere::transmittance(float sine_of_elevation, float distance_m) const {
    glm::vec3 depth(0);
    constexpr int samples = 8;
    for (int i = 0; i < samples; ++i) {
        const float at = distance_m * (static_cast<float>(i) + 0.5f) / samples;
        const float h = std::max(0.f, height_at(0, sine_of_elevation, at));
        depth += rayleigh_per_m * std::exp(-h / rayleigh_height_m) + haze_per_m_ * std::exp(-h / mie_height_m);
    }
    return glm::exp(-depth * (distance_m / samples));
}

void Atmosphere::fill_line(int line) {
    const float sun_across = std::sqrt(std::max(0.f, 1 - sun_.y * sun_.y));
    const float root = static_cast<float>(line) / (elevations - 1);
    const float sine = root * root, across = std::sqrt(1 - sine * sine);
    for (int a = 0; a < azimuths; ++a) {
        const float azimuth = pi_v<float> * static_cast<float>(a) / (azimuths - 1);
        const float length = distance_to_height(0, sine, atmosphere_top_m);
        Scattered sum;
        glm::vec3 depth(0);
        float before = 0;
        for (int i = 1; i <= view_samples; ++i) {
            const float fraction = static_cast<float>(i) / view_samples;
            const float end = length * fraction * fraction, at = (before + end) / 2, step = end - before;
            before = end;
            const float h = std::max(0.f, height_at(0, sine, at));
            const float air = std::exp(-h / rayleigh_height_m), haze = std::exp(-h / mie_height_m);
            const glm::vec3 step_depth =
                (rayleigh_per_m * air + haze_per_m_ * haze + ozone_per_m * relative_ozone(h)) * step;
            // The zenith rotates by the horizontal distance over the earth's radius; the sun's
            // elevation changes accordingly.
            const float turn = at * across / earth_radius_m;
            const float sun_sine = sun_.y * std::cos(turn) + sun_across * std::cos(azimuth) * std::sin(turn);
            const float r = earth_radius_m;
            const float horizon = -std::sqrt(std::max(0.f, 1 - (r / (r + h)) * (r / (r + h))));
            const float lit = glm::clamp((sun_sine - horizon) / 0.0094f + 0.5f, 0.f, 1.f);
            if (lit > 0) {
                const glm::vec3 light = lit * glm::exp(-(depth + 0.5f * step_depth + optical_depth(h, sun_sine)));
                sum.rayleigh += light * rayleigh_per_m * (air * step);
                sum.mie += light * (haze_per_m_ * mie_albedo * haze * step);
            }
            const glm::vec3 scattering = rayleigh_per_m * air + haze_per_m_ * mie_albedo * haze;
            sum.multiple += glm::exp(-(depth + 0.5f * step_depth)) * scattering * (step / (4 * pi_v<float>));
            depth += step_depth;
        }
        table_[static_cast<std::size_t>(line * azimuths + a)] = sum;
    }
}

// Before this call, `multiple` holds the radiance of the sky for incident light that sums to 1 over
// all directions at every point. Each scattering order is lit by the previous order, which is
// assumed equal at all heights and in all directions. The orders therefore shrink by a constant
// factor, and their sum is a geometric series (the method of Hillaire 2020, "A Scalable and
// Production Ready Sky", with one point).
void Atmosphere::finish() {
    glm::vec3 first(0), second(0);
    float weights = 0;
    for (int e = 0; e < elevations; ++e)
        for (int a = 0; a < azimuths; ++a) {
            const float root = static_cast<float>(e) / (elevations - 1), sine = root * root;
            const float azimuth = pi_v<float> * static_cast<float>(a) / (azimuths - 1);
            const float across = std::sqrt(1 - sine * sine);
            const glm::vec3 direction(across * std::cos(azimuth), sine, across * std::sin(azimuth));
            const Scattered& here = table_[static_cast<std::size_t>(e * azimuths + a)];
            const float to_sun = sun_.y * sine + std::sqrt(1 - sun_.y * sun_.y) * direction.x;
            const float weight = root;  // for equal steps in the square root of the sine
            first += weight * (here.rayleigh * rayleigh_phase(to_sun) + here.mie * mie_phase(to_sun, mie_asymmetry));
            second += weight * here.multiple;
            weights += weight;
        }
    // Integrates over the upper hemisphere only, because the sea reflects little light upwards.
    const glm::vec3 light = first * (2 * pi_v<float> / weights), ratio = second * (2 * pi_v<float> / weights);
    for (Scattered& entry : table_) entry.multiple *= light / (1.f - glm::min(ratio, glm::vec3(0.9f)));
}

glm::vec3 Atmosphere::radiance(glm::vec3 direction) const {
    const float sun_across = std::sqrt(std::max(1e-8f, 1 - sun_.y * sun_.y));
    const float across = std::sqrt(std::max(1e-8f, direction.x * direction.x + direction.z * direction.z));
    const float cosine = (direction.x * sun_.x + direction.z * sun_.z) / (across * sun_across);
    const float azimuth = std::acos(glm::clamp(cosine, -1.f, 1.f)) / pi_v<float> * (azimuths - 1);
    const float elevation = std::sqrt(std::clamp(direction.y, 0.f, 1.f)) * (elevations - 1);
    const int e = std::min(static_cast<int>(elevation), elevations - 2);
    const int a = std::min(static_cast<int>(azimuth), azimuths - 2);
    const float fe = elevation - static_cast<float>(e), fa = azimuth - static_cast<float>(a);
    const auto at = [&](int de, int da) -> const Scattered& {
        return table_[static_cast<std::size_t>((e + de) * azimuths + a + da)];
    };
    const auto mixed = [&](glm::vec3 Scattered::*field) {
        return (1 - fe) * ((1 - fa) * at(0, 0).*field + fa * at(0, 1).*field) +
               fe * ((1 - fa) * at(1, 0).*field + fa * at(1, 1).*field);
    };
    const float to_sun = glm::dot(direction, sun_);
    return mixed(&Scattered::rayleigh) * rayleigh_phase(to_sun) +
           mixed(&Scattered::mie) * mie_phase(to_sun, mie_asymmetry) + mixed(&Scattered::multiple);
}

}  // namespace pelagic::gl
