// Images may use less than the whole of their texture: the lower left part. gl/display.cpp.

// Texture coordinates of a place in [0, 1], no nearer to the used part's edge than the texels' middles.
// \param used  xy: the used part of the texture; zw: a texel
vec2 in_used_part(vec2 place, vec4 used) { return clamp(place * used.xy, 0.5 * used.zw, used.xy - 0.5 * used.zw); }

// Samples carry the weight in alpha by which they were multiplied (tone.glsl).
vec3 unweighted(vec4 texel) { return texel.rgb / max(texel.a, 1e-4); }
