// Shore (sim/shore_surface.hpp). At a displaced position each cascade has a weight, and waves that
// the floor transforms are added to the sum. Samples beyond the rectangle return the values on its
// edges: the weights there, and no waves.
uniform mediump sampler2D shore_weights;  // weights of the cascades
uniform highp sampler2D shore_water;    // height, its slopes along x and z, foam
uniform highp sampler2D shore_reach;    // height that passing waves reach above still water

vec2 shore_uv(vec2 at) { return shore_place.xy + at * shore_place.zw; }

vec4 weights_of_cascades(vec2 at) { return textureLod(shore_weights, shore_uv(at), 0.0); }

// Returns the mip whose texels have the length long_m.
float shore_mip(float long_m) { return clamp(log2(max(long_m * shore_size.z, 1e-6)), 0.0, shore_size.w); }

// Texels of coarse mips on the edges cover the inside of the rectangle, so waves fade out within
// one texel of the mip.
vec4 shore_water_at(vec2 at, float mip) {
    vec2 uv = shore_uv(at);
    vec2 within = (0.5 - abs(uv - 0.5)) * shore_size.xy - 0.5;  // texels of mip 0
    float there = clamp((min(within.x, within.y) + 1e-3) / max(exp2(mip) - 1.0, 1e-3), 0.0, 1.0);
    return textureLod(shore_water, uv, mip) * there;
}

// Returns the height. The finest mip is interpolated with cubics (Keys 1981), as in queries: 4 x 4
// texels in 3 x 3 linear samples, where the middle sample combines the two middle texels. Coarser
// mips are linear.
float shore_height_at(vec2 at, float mip) {
    float coarse = shore_water_at(at, mip).x;
    if (mip >= 1.0) return coarse;
    vec2 place = clamp(shore_uv(at) * shore_size.xy - 0.5, vec2(0.0), shore_size.xy - 1.0);
    vec2 texel = floor(place), t = place - texel;
    vec2 before = 0.5 * t * (t * (2.0 - t) - 1.0), here = 0.5 * (t * t * (3.0 * t - 5.0) + 2.0);
    vec2 after = 0.5 * t * t * (t - 1.0), both = 1.0 - before - after;
    vec2 weights[3] = vec2[3](before, both, after);
    vec2 places[3] = vec2[3](texel - 0.5, texel + 0.5 + (1.0 - here / both), texel + 2.5);
    float fine = 0.0;
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            fine += weights[column].x * weights[row].y *
                    textureLod(shore_water, vec2(places[column].x, places[row].y) / shore_size.xy, 0.0).x;
    return mix(fine, coarse, mip);
}
