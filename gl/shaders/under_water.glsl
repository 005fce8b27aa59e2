// View under water: the light of the water, with shafts of light.

// Returns the mean sunlight along a ray, relative to sunlight without caustics. The pattern of the
// caustics extends along the sun's rays. The view ray is sampled at a few points, denser near the
// eye. Each sample takes the mean over the distance to the next. Offsets vary from pixel to pixel
// to hide the steps.
float shafts_along(vec3 start, vec3 ray, float path) {
#if SHADING == HEADSET
    return 1.0;
#else
    const int places = 10;
    vec3 to_sun = sun_in_water();
    vec2 slant = to_sun.xz / to_sun.y;
    float across = length(ray.xz + slant * -ray.y);
    float reach = min(path, 30.0);
    float offset = 0.5 + 0.5 * (fract(52.9829189 * fract(dot(gl_FragCoord.xy, vec2(0.06711056, 0.00583715)))) - 0.5);
    float sum = 0.0, weights = 0.0;
    for (int i = 0; i < places; ++i) {
        float fraction = (float(i) + offset) / float(places);
        float apart = 2.0 * reach * fraction / float(places);
        vec3 at = start + ray * (reach * fraction * fraction);
        float depth = depth_of(at);
        float weight = fraction * exp(-0.06 * reach * fraction * fraction);
        float light = caustics_at(at.xz + slant * depth, max(depth, 0.6 * caustic_row[0].w), 0.6 * apart * across);
        sum += weight * (light - 1.0) * exp(-0.045 * depth);
        weights += weight;
    }
    return max(1.0 + 1.6 * sum / weights, 0.0);
#endif
}

// Returns `radiance` as seen through `path` metres of water along the ray.
vec3 through_water(vec3 radiance, vec3 start, vec3 ray, float path) {
    return radiance * exp(-attenuation_of_water() * path) +
           scattered_light(ray, depth_of(start), path, shafts_along(start, ray, path));
}
