// Slopes and roughness of a pixel of small water (small_water.glsl).
// Velocity of a river along x and z. The byte 128 is zero and 255 is the maximum speed.
uniform highp sampler2D flow;

#if SURFACE == RIVER
// Returns noise that the flow advects. Two copies, half a cycle apart, are advected and restart
// when their weight is 0. Variances of independent waves add, so the weights are divided by the
// root of the sum of their squares. Fast water is rougher than still water.
Bumps flowing_bumps(vec2 at, float pixel_m) {
    vec2 velocity = (texture(flow, at * flow_place.z + flow_place.xy).xy * 255.0 - 128.0) / 127.0;
    vec2 displacement = velocity * flow_cycle.z;  // displacement in a cycle
    float rough = mix(0.3, 1.0, min(length(velocity), 1.0));
    Bumps first = sum_of_octaves(at - displacement * (flow_cycle.x - 0.5) + flow_jump.xy, pixel_m, rough);
    Bumps second = sum_of_octaves(at - displacement * (flow_cycle.y - 0.5) + flow_jump.zw, pixel_m, rough);
    float weight = 1.0 - abs(2.0 * flow_cycle.x - 1.0);
    vec2 weights = vec2(weight, 1.0 - weight) * inversesqrt(weight * weight + (1.0 - weight) * (1.0 - weight));
    return Bumps(0.0, weights.x * first.gradient + weights.y * second.gradient, first.unresolved, 0.0);
}
#endif

Bumps small_bumps(vec2 at, float pixel_m) {
#if SURFACE == POND
    return sum_of_pond_waves(at, pixel_m);
#elif SURFACE == RIVER
    return flowing_bumps(at, pixel_m);
#elif SURFACE == LAKE
    return sum_of_octaves(at, pixel_m, sqrt(gust_at(at)));
#else
    return sum_of_octaves(at, pixel_m, 1.0);
#endif
}

Waves waves_at(vec2 at, float distance_m) {
    // Near the horizon a pixel's footprint is long and narrow. Half of its length keeps waves
    // across the footprint with little aliasing.
    Footprint pixel = footprint_of(at);
    float a = length(pixel.dx), b = length(pixel.dy);
    Bumps seen = small_bumps(at, max(min(a, b), 0.5 * max(a, b)));
    vec2 slopes = -seen.gradient / max(1.0, length(seen.gradient) / 4.0);
    return Waves(slopes, clamp(seen.unresolved, 0.0004, 1.0), seen.unresolved, SURFACE == COAST ? seen.crest * bump_kind.y : 0.0, 0.0);
}
