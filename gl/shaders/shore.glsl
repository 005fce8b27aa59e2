// A shore, as sim/shore_surface.hpp says: at a place where water is drawn each tile counts with its part, and waves that feel the floor add to
// the sum. Look-ups beyond the rectangle have what its edges have: all of the tiles, and no waves.
uniform mediump sampler2D shore_parts;  // of the tiles
uniform highp sampler2D shore_water;    // height, its slopes along x and z, foam
uniform highp sampler2D shore_reach;    // how high the waves that are passing reach, above rest

vec2 shore_uv(vec2 at) { return shore_place.xy + at * shore_place.zw; }

vec4 parts_of_tiles(vec2 at) { return textureLod(shore_parts, shore_uv(at), 0.0); }

// A texel of that mip is as long as `long_m`.
float shore_mip(float long_m) { return clamp(log2(max(long_m * shore_size.z, 1e-6)), 0.0, shore_size.w); }

// Texels of coarse mips reach into the rectangle, so on their way out of it waves end within one of them.
vec4 shore_water_at(vec2 at, float mip) {
    vec2 uv = shore_uv(at);
    vec2 within = (0.5 - abs(uv - 0.5)) * shore_size.xy - 0.5;  // texels of mip 0
    float there = clamp((min(within.x, within.y) + 1e-3) / max(exp2(mip) - 1.0, 1e-3), 0.0, 1.0);
    return textureLod(shore_water, uv, mip) * there;
}
