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

// Returns the caustics of a ray. `at` is where the ray enters flat water, relative to the viewer,
// and `pixel_m` is the width of a pixel there.
float caustics_at(vec2 at, float depth, float pixel_m) {
    float focus = caustic_row[0].w;  // depth for which the caustics were baked
    // Near the surface light is still uniform. Far below the focus the rays of many waves mix.
    float seen = min(depth / focus, 1.0) * exp(-max(depth / focus - 1.0, 0.0));
    float light = mix(rows_of_crests(at), 1.0, smoothstep(0.1, 0.6, pixel_m));
#if SHADING != HEADSET
    if (caustic_place.z != 0.0 || caustic_place.w != 0.0) {
        vec2 turn = caustic_place.zw;
        vec2 uv = caustic_place.xy + vec2(turn.x * at.x + turn.y * at.y, turn.x * at.y - turn.y * at.x);
        float texels_a_m = length(turn) * float(textureSize(caustics, 0).x);
        light = textureLod(caustics, uv, log2(max(pixel_m * texels_a_m, 1.0))).x;
    }
#endif
    return mix(1.0, light, max(seen, 0.0));
}
