#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "pelagic/floating/hull.hpp"
#include "pelagic/tests/hull_meshes.hpp"
#include "pelagic/tests/still_water.hpp"

namespace pelagic {
namespace {

struct Response {
    double heave, pitch;
};
/// Returns amplitudes of heave over that of the wave, and of pitch over that of its slope.
Response response(const Hull& hull, double wavelength_m, double heading_rad = 0, int periods = 30) {
    RegularWave water(heading_rad);
    const double k = two_pi / wavelength_m, omega = std::sqrt(gravity_mps2 * k), period = two_pi / omega;
    const double amplitude_m = 0.005 * wavelength_m;
    constexpr int steps = 120;
    const double t = period / steps;
    HullWorkspace workspace;
    HullState state = hull.at_rest(0, 0);
    double cosine = 0, sine = 0, pitch_cosine = 0, pitch_sine = 0;
    for (int i = 0; i < steps * periods; ++i) {
        water.set_wave(amplitude_m, k, (i + 0.5) * t);
        hull.step(water, state, t, {}, workspace);
        state.position_m.x = state.position_m.z = 0;  // without drift
        state.velocity_mps.x = state.velocity_mps.x;
        if (i < steps * (periods - 4)) continue;
        const double phase = -omega * (i + 1) * t, heave = state.position_m.y - hull.afloat().height_m;
        const glm::dvec3 ahead = glm::mat3_cast(state.orientation)[0];
        cosine += heave * std::cos(phase), sine += heave * std::sin(phase);
        pitch_cosine += ahead.y * std::cos(phase), pitch_sine += ahead.y * std::sin(phase);
    }
    const double samples = steps * 4 / 2;
    return {std::hypot(cosine, sine) / samples / amplitude_m,
            std::hypot(pitch_cosine, pitch_sine) / samples / (k * amplitude_m)};
}

TEST(HullResponse, Prints) {
    HullMatrix added{};
    {
        const double r = 2, rho = 1025, draught = 20;
        added[1][1] = rho * 8.0 / 3 * r * r * r / 2;
        added[0][0] = added[2][2] = rho * std::numbers::pi * r * r * draught;
        added[3][3] = added[5][5] = added[0][0] * draught * draught / 12;
        const double mass = rho * std::numbers::pi * r * r * draught;
        const Hull spar(cylinder_mesh(r, 24, 24, 12), {.mass_kg = mass, .centre_of_mass_m = glm::dvec3(0, -6, 0), .added_mass = added, .heave_damping = 0.02});
        std::printf("spar draught %.3f\n", spar.afloat().draught_m);
        for (const double length : {400., 300., 250., 200., 160., 140., 120., 100., 80., 60., 50., 40.}) {
            const double k = two_pi / length, w2 = gravity_mps2 * k, S = rho * gravity_mps2 * std::numbers::pi * r * r;
            const double f = (S - w2 * added[1][1]) * std::exp(-k * draught) / (S - w2 * (mass + added[1][1]));
            const Response got = response(spar, length, 0, 60);
            std::printf("  %4.0f m heave %.4f, Froude-Krylov with added mass %.4f\n", length, got.heave, std::fabs(f));
        }
    }
}

}  // namespace
}  // namespace pelagic
