// An AnalyticSea as text for a shader.
#pragma once

#include <string>

#include "pelagic/analytic/plane_waves.hpp"

namespace pelagic {

/// Where and when a shader's zero is. Its floats tell 600 s and some hundred wavelengths well: print the text again
/// further on.
struct GlslOrigin {
    double time_s = 0, x_m = 0, z_m = 0;
};

/// GLSL ES 3.00 with the waves as constants, no uniforms and no textures, for vertex and fragment shaders of
/// `precision highp float`:
///
///   struct AnalyticWater { vec3 displacement; vec3 normal; float jacobian; };  metres, unit
///   AnalyticWater analytic_water(vec2 reference_m, float time_s)                    both from `origin` on
///
/// The same displacement and normal as AnalyticSurface::sample_undisplaced() to 1e-3 of the sum of the amplitudes.
/// Throws std::invalid_argument with check(sea)'s line. \pre the origin is finite
std::string analytic_glsl(const AnalyticSea& sea, const GlslOrigin& origin = {});
std::string analytic_glsl(const PlaneWaves& sea, const GlslOrigin& origin = {});

}  // namespace pelagic
