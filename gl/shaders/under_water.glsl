// What an eye in the water sees: its own water, with shafts of light in it.

// Shafts of light: the caustics' pattern stands in the water along the sun's rays. A few places of the eye's ray, nearer ones
// closer together, each with the mean of what lies between it and the next; moved a little from pixel to pixel, so that no
// steps show.
float shafts_along(vec3 start, vec3 ray, float way) {
#if SHADING == HEADSET
    return 1.0;
#else
    const int places = 10;
    vec3 to_sun = sun_in_water();
    vec2 slant = to_sun.xz / to_sun.y;
    float across = length(ray.xz + slant * -ray.y);
    float reach = min(way, 30.0);
    float offset = 0.5 + 0.5 * (fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5);
    float sum = 0.0, weights = 0.0;
    for (int i = 0; i < places; ++i) {
        float part = (float(i) + offset) / float(places);
        float apart = 2.0 * reach * part / float(places);
        vec3 at = start + ray * (reach * part * part);
        float depth = depth_of(at);
        float weight = part * exp(-0.06 * reach * part * part);
        float light = caustics_at(at.xz + slant * depth, max(depth, 0.6 * caustic_row[0].w), 0.6 * apart * across);
        sum += weight * (light - 1.0) * exp(-0.045 * depth);
        weights += weight;
    }
    return max(1.0 + 1.6 * sum / weights, 0.0);
#endif
}

// What is seen through water: `radiance`, `way` metres ahead along the ray.
vec3 through_water(vec3 radiance, vec3 start, vec3 ray, float way) {
    return radiance * exp(-attenuation_of_water() * way) +
           scattered_light(ray, depth_of(start), way, shafts_along(start, ray, way));
}
