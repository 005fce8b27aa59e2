// The floor as seen from above through the water.

// Returns light from below the surface: upwelling light of the water down to the floor, and light
// of the floor, attenuated along the refracted ray. Slopes within the pixel deflect rays to both
// sides by a quarter of their angle.
vec3 light_from_below(vec3 at, vec3 normal, vec3 to_eye, float distance_m, float alpha2) {
    if (floor_albedo.w < 0.5) return upwelling(normal, to_eye);
    vec3 ray = refract(-to_eye, normal, 1.0 / water_index);
    ray = normalize(vec3(ray.x, min(ray.y, -0.3), ray.z));
    float path = path_to_floor(at, ray);
    vec3 k = attenuation_of_water();
    vec3 there_and_back = exp(-k * (path * (1.0 - ray.y)));
    vec3 bottom = floor_light(at + ray * path, pixel_on_floor(distance_m + path) + 0.5 * sqrt(0.5 * alpha2) * path);
    // Refraction at the surface widens rays, which divides radiance by the square of the index.
    return upwelling(normal, to_eye) * (1.0 - there_and_back) + bottom * exp(-k * path) / (water_index * water_index);
}

// Fades out the last decimetres of water, so that there is no hard line between sea and sand. Foam
// that waves leave on a beach is at most a few centimetres thick but hides the sand.
vec3 soft_shore(vec3 radiance, vec3 at, float distance_m, float height, float foam) {
    if (!has_floor_heights()) return radiance;
    float ground = floor_height(at.xz, 0.0);
    float there = smoothstep(0.0, 0.3, height - ground);
#ifdef SHORE
    there = max(there, foam * smoothstep(0.0, 0.04, height - ground));
#endif
    if (there >= 1.0) return radiance;
    return mix(floor_light(vec3(at.x, ground - viewer.z, at.z), pixel_on_floor(distance_m)), radiance, there);
}
