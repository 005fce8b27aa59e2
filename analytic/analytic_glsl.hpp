// Generates GLSL that evaluates an analytic sea.
#pragma once

#include <string>

#include "pelagic/analytic/plane_waves.hpp"

namespace pelagic {

/// Origin of a shader's coordinates. Floats are accurate up to 600 s and some hundred wavelengths
/// from it; beyond, generate the text again with a new origin.
struct GlslOrigin {
    double time_s = 0, x_m = 0, z_m = 0;
};

/// Returns GLSL ES 3.00 for vertex and fragment shaders with `precision highp float`. The waves are
/// constants; the text has no uniforms and no textures. It declares
///
///   struct AnalyticWater { vec3 displacement; vec3 normal; float jacobian; };  metres, unit
///   AnalyticWater analytic_water(vec2 reference_m, float time_s)              relative to `origin`
///
/// Displacement and normal differ from AnalyticSurface::sample_undisplaced() by at most 1e-3 of the
/// sum of the amplitudes.
/// \throws std::invalid_argument with the message of check(sea), if it is not empty
/// \pre the origin is finite
std::string analytic_glsl(const AnalyticSea& sea, const GlslOrigin& origin = {});
/// As above, for plane waves.
/// \throws std::invalid_argument with the message of check(sea), if it is not empty
std::string analytic_glsl(const PlaneWaves& sea, const GlslOrigin& origin = {});

}  // namespace pelagic
