#include "pelagic/analytic/analytic_glsl.hpp"

#include <cmath>
#include <stdexcept>

#include "pelagic/analytic/wave_phase.hpp"
#include "pelagic/message/number_text.hpp"
#include "pelagic/message/require.hpp"
#include "pelagic/simd/float_environment.hpp"

namespace pelagic {
namespace {

/// Returns a GLSL float literal.
std::string literal(double value) {
    const std::string text = number_text(static_cast<float>(value));
    return text.find_first_of(".e") == std::string::npos ? text + ".0" : text;
}

// `fract` precedes the sine, because GLSL does not specify the sine's accuracy for large angles.
constexpr const char* functions = R"(
struct AnalyticWater { vec3 displacement; vec3 normal; float jacobian; };

AnalyticWater analytic_water(vec2 reference_m, float time_s) {
    vec3 moved = vec3(0.0, analytic_level, 0.0);
    vec2 slope = vec2(0.0);
    vec3 contraction = vec3(0.0);  // derivatives of the horizontal displacement: xx, xz, zz
    for (int i = 0; i < analytic_waves; ++i) {
        vec4 wave = analytic_wave[i];      // direction, turns per metre, amplitude
        vec2 turn = analytic_turn[i];      // turns at the origin, turns per second
        float phase = 6.2831853 * fract(dot(wave.xy, reference_m) * wave.z - turn.y * time_s + turn.x);
        float s = sin(phase), c = cos(phase), steepness = 6.2831853 * wave.z * wave.w;
        moved.xz -= analytic_choppiness * wave.w * s * wave.xy;
        moved.y += wave.w * c;
        slope -= steepness * s * wave.xy;
        contraction -= analytic_choppiness * steepness * c * vec3(wave.x * wave.xy, wave.y * wave.y);
    }
    float xx = 1.0 + contraction.x, xz = contraction.y, zz = 1.0 + contraction.z, jacobian = xx * zz - xz * xz;
    vec3 normal = vec3(slope.y * xz - slope.x * zz, jacobian, slope.x * xz - slope.y * xx);
    return AnalyticWater(moved, normalize(normal), jacobian);
}
)";

}  // namespace

std::string analytic_glsl(const AnalyticSea& sea, const GlslOrigin& origin) {
    require(check(sea));
    return analytic_glsl(plane_waves_of(sea), origin);
}

std::string analytic_glsl(const PlaneWaves& sea, const GlslOrigin& origin) {
    require(check(sea));
    const DefaultFloatEnvironment environment;
    const std::string count = number_text(sea.waves.size());
    std::string waves, turns;
    for (const PlaneWave& wave : sea.waves) {
        const double per_m = wave.turns_per_m(), x = wave.turns_per_m_x / per_m, z = wave.turns_per_m_z / per_m;
        const double at_origin = wave.turns_per_m_x * origin.x_m + wave.turns_per_m_z * origin.z_m;
        const double start =
            turns_at_origin(wave.phase_turns + (at_origin - std::floor(at_origin)), wave.frequency_hz, origin.time_s);
        const char* comma = waves.empty() ? "" : ",";
        waves += comma + ("\n    vec4(" + literal(x) + ", " + literal(z) + ", " + literal(per_m) + ", " +
                          literal(wave.amplitude_m) + ")");
        turns += comma + ("\n    vec2(" + literal(start) + ", " + literal(wave.frequency_hz) + ")");
    }
    return "const int analytic_waves = " + count + ";\n" +
           "const float analytic_choppiness = " + literal(sea.choppiness) + ";\n" +
           "const float analytic_level = " + literal(sea.level_m) + ";\n" + "const vec4 analytic_wave[" +
           count + "] = vec4[" + count + "](" + waves + ");\n" + "const vec2 analytic_turn[" + count + "] = vec2[" +
           count + "](" + turns + ");\n" + functions;
}

}  // namespace pelagic
