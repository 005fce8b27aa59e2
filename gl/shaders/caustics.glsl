// Caustics: sunlight on a plane below the water, relative to its mean. The texture is baked from
// the frame's surface (gl/water/caustics.hpp). Headsets, and applications that set no caustics, use
// three rows of crests. Both have a mean of 1.
#if SHADING != HEADSET
uniform sampler2D caustics;
#endif

// Returns three rotated rows of crests: the cube of a sum of half-rectified cosines, which gives
// thin lines. For cosines c with independent phases the mean of (c1 + c2 + c3)^3 is 3 <c^3> + 18
// <c^2><c> + 6 <c>^3 = 2.2625.
float rows_of_crests(vec2 at) {
    vec3 phase = vec3(dot(at, caustic_row[0].xy), dot(at, caustic_row[1].xy), dot(at, caustic_row[2].xy)) +
                 vec3(caustic_row[0].z, caustic_row[1].z, caustic_row[2].z);
    // Crests of one row are bent by the next row, because straight crests would form a grid.
    vec3 c = max(cos(phase + 1.1 * sin(0.37 * phase.yzx)), 0.0);
    float sum = c.x + c.y + c.z;
    return mix(1.0, sum * sum * sum / 2.2625, 0.6);
}

// Returns the part of the pattern that is visible at a depth. Near the surface light is still
// uniform. Far below the focus the rays of many waves mix.
float caustics_seen(float light, float depth) {
    float focus = caustic_row[0].w;  // depth for which the caustics were baked
    return mix(1.0, light, max(min(depth / focus, 1.0) * exp(-max(depth / focus - 1.0, 0.0)), 0.0));
}

#if SHADING != HEADSET
bool has_baked_caustics() { return caustic_place.z != 0.0 || caustic_place.w != 0.0; }

// Converts a vector in metres to a difference of the texture coordinates of the caustics.
vec2 rotated_into_caustics(vec2 at) {
    vec2 turn = caustic_place.zw;
    return vec2(turn.x * at.x + turn.y * at.y, turn.x * at.y - turn.y * at.x);
}

float mip_of_caustics(float pixel_m) {
    return log2(max(pixel_m * length(caustic_place.zw) * float(textureSize(caustics, 0).x), 1.0));
}
#endif

float rows_in_pixel(vec2 at, float pixel_m) { return mix(rows_of_crests(at), 1.0, smoothstep(0.1, 0.6, pixel_m)); }

// Returns the caustics of a ray. `at` is where the ray enters flat water, relative to the viewer,
// and `pixel_m` is the width of a pixel there.
float caustics_at(vec2 at, float depth, float pixel_m) {
    float light = rows_in_pixel(at, pixel_m);
#if SHADING != HEADSET
    if (has_baked_caustics())
        light = textureLod(caustics, caustic_place.xy + rotated_into_caustics(at), mip_of_caustics(pixel_m)).x;
#endif
    return caustics_seen(light, depth);
}

#if SHADING != HEADSET
// Returns the offset of a copy of the texture. Offsets are pseudo-random, because those of a
// sequence would repeat the pattern at the difference of successive offsets.
vec2 offset_of_copy(float copy) { return fract(sin(copy * vec2(127.1, 311.7) + vec2(1.3, 4.7)) * 437.585); }

// Returns the caustics on a floor, where the period of the texture would be visible. `noise` is
// smooth and has a mean of 0. Its integer part selects two copies at pseudo-random offsets. Their
// differences from the mean are blended with weights whose squares sum to 1, which preserves mean
// and variance (Heitz and Neyret 2018).
float caustics_of_copies(vec2 at, float depth, float pixel_m, float noise) {
    vec2 uv = caustic_place.xy + rotated_into_caustics(at);
    float copy = floor(noise), mip = mip_of_caustics(pixel_m);
    float second = smoothstep(0.25, 0.75, noise - copy);
    float light = 1.0 + sqrt(1.0 - second) * (textureLod(caustics, uv + offset_of_copy(copy), mip).x - 1.0) +
                  sqrt(second) * (textureLod(caustics, uv + offset_of_copy(copy + 1.0), mip).x - 1.0);
    return caustics_seen(max(light, 0.0), depth);
}

// Returns the position in the noise that selects the copies.
vec2 noise_of_caustics(vec2 at) { return caustic_copies.xy + rotated_into_caustics(at) * caustic_copies.z; }
#endif
