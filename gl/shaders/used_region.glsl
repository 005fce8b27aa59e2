// Images may cover only the lower left rectangle of their texture (gl/display.cpp).

// Converts a position in [0, 1] to texture coordinates, clamped to the outermost texel centres.
// \param used  xy: fraction of the texture that the image covers; zw: size of a texel
vec2 in_used_region(vec2 place, vec4 used) { return clamp(place * used.xy, 0.5 * used.zw, used.xy - 0.5 * used.zw); }

// Divides by alpha, which holds the weight of a sample (weighted_sample() in film.glsl).
vec3 unweighted(vec4 texel) { return texel.rgb / max(texel.a, 1e-4); }
