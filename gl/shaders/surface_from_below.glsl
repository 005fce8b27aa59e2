// The surface seen from under water: Snell's window, and total internal reflection around it.

// Returns the light that the surface reflects along a ray that leads down or is level: the floor if
// it is near, and light of the water. `slopes` is a standard deviation. The longer the path, the
// larger is the area of the floor in a pixel.
vec3 seen_in_water(vec3 start, vec3 ray, float slopes) {
    ray = normalize(vec3(ray.x, min(ray.y, -0.02), ray.z));
    float path = path_to_floor(start, ray);
    vec3 light = scattered_light(ray, depth_of(start), path, 1.0);
    if (path < 400.0) {
        vec3 at = start + ray * path;
        float pixel_m = pixel_on_floor(length(start - eye[EYE].xyz) + path) + 4.0 * slopes * path;
        light += floor_light(at, pixel_m) * exp(-attenuation_of_water() * path);
    }
    return light;
}

// Returns the Fresnel reflectance of unpolarised light from the water, which is 1 beyond the
// critical angle.
float fresnel_from_below(float cosine) {
    float square = 1.0 - water_index * water_index * (1.0 - cosine * cosine);
    if (square <= 0.0) return 1.0;
    float in_air = sqrt(square);
    float parallel = (cosine - water_index * in_air) / (cosine + water_index * in_air);
    float crosswise = (water_index * cosine - in_air) / (water_index * cosine + in_air);
    return 0.5 * (parallel * parallel + crosswise * crosswise);
}

// Returns sunlight through the rough surface: Walter et al. 2007, equations 16 and 21, for light
// from air and an eye in the water.
float sun_through(vec3 normal, vec3 to_eye, float alpha2) {
    vec3 middle = -(sun.xyz + water_index * to_eye);
    float turned = length(middle);
    middle /= max(turned, 1e-4);
    float nh = dot(normal, middle), ih = dot(sun.xyz, middle), oh = -dot(to_eye, middle);
    if (nh <= 0.0 || ih <= 0.0 || oh <= 0.0) return 0.0;
    // A facet deflects light by a quarter of its tilt, so the disc corresponds to facet tilts four
    // times as wide.
    alpha2 += 16.0 * sun.w * sun.w;
    float d = nh * nh * (alpha2 - 1.0) + 1.0;
    float distribution = alpha2 / (pi * d * d);
    float across = water_index * oh - ih;
    return ih * oh * water_index * water_index * (1.0 - fresnel_from_below(oh)) * distribution /
           (max(dot(normal, -to_eye), 0.05) * max(across * across, 1e-4));
}

// Returns the radiance of the surface from below: Snell's window, and total internal reflection
// beyond 48.6 degrees. Foam transmits diffuse light: it is darker than the sky and brighter than
// the reflection.
vec3 surface_from_below(vec3 at, vec3 normal, vec3 to_eye, float alpha2, Foam foam, float distance_m) {
    vec3 ray = -to_eye;
    float cosine = clamp(dot(ray, normal), 0.01, 1.0);
    // Slopes within the pixel soften the edge of the window.
    float s = sqrt(0.5 * alpha2);
    float leans = 1.4 * s * sqrt(1.0 - cosine * cosine);
    float mirrors = 0.5 * fresnel_from_below(cosine) + 0.25 * fresnel_from_below(min(cosine + leans, 1.0)) +
                    0.25 * fresnel_from_below(max(cosine - leans, 0.01));
    float square = 1.0 - water_index * water_index * (1.0 - cosine * cosine);
    vec3 out_of = normalize(water_index * ray + (sqrt(max(square, 0.0)) - water_index * cosine) * normal);
    // Refraction into water narrows rays, which multiplies radiance by the square of the index.
    vec3 above = textureLod(sky, vec3(out_of.x, max(out_of.y, 0.01), out_of.z),
                            sqrt(0.5 * sqrt(alpha2)) * sky_irradiance.w).rgb * (water_index * water_index);
    vec3 mirrored = mirrors > 0.001 ? seen_in_water(at, reflect(ray, normal), s) : vec3(0.0);
    vec3 radiance = mix(above, mirrored, mirrors) +
                    sun_irradiance.rgb * min(sun_through(normal, to_eye, alpha2), 3e3);
    vec3 through_foam = (1.0 - foam_albedo(foam.thickness)) / pi * (sunlight_below() + skylight_below());
    radiance = mix(radiance, through_foam, foam.cover * mix(0.5, 0.95, foam.thickness));
    return through_water(radiance, eye[EYE].xyz, ray, distance_m);
}
