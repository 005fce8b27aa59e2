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

// Facets of a pixel on both sides of the critical angle. Fresnel's transmittance rises from 0 as
// the root of the distance to that angle, so samples at a few facets would draw steps.
struct WindowFacets {
    float transmitted;  // mean transmittance of all facets
    float window;       // mean cosine of incidence of the facets that transmit
    float mirrors;      // mean cosine of the facets that reflect
};

// The cosines of the visible facets have a Gaussian distribution with mean m and deviation d. The
// fraction P(a) with a = (m - c) / d exceeds the critical cosine c. The mean of this fraction is
// m + d p(a) / P(a), and that of the others is m - d p(a) / (1 - P(a)). The transmittance is that
// of the mean facet of the fraction. The root is concave, which the factor 0.8 includes: the error
// of the transmittance is at most 0.024.
WindowFacets window_facets(SeenFacets seen, float spread) {
    const float critical = 0.66122;  // sqrt(1 - 1 / n^2)
    float a = clamp((seen.cosine - critical) / spread, -4.0, 4.0);
    float density = 0.3989423 * exp(-0.5 * a * a);
    float part = 1.0 / (1.0 + exp(-1.5976 * a - 0.070566 * a * a * a));  // Page 1977
    float window = clamp(seen.cosine + spread * density / part, critical, 1.0);
    float concave = mix(0.8, 1.0, clamp(a / 3.0, 0.0, 1.0));
    window = sqrt(critical * critical + (window * window - critical * critical) * (concave * concave));
    float others = clamp(seen.cosine - spread * density / (1.0 - part), 0.01, 1.0);
    return WindowFacets(part * (1.0 - fresnel_from_below(window)), window, mix(others, seen.cosine, part));
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
    // The glint needs a minimum of alpha2 (waves.glsl), but the window of a calm sea is sharper.
    float s = sqrt(0.5 * max(alpha2 - 0.0004, 0.0)), t = sqrt(max(1.0 - cosine * cosine, 1e-8));
    SeenFacets seen = seen_facets(cosine, s);
    // The direction to the eye varies over a pixel too; 1/12 is the variance of its width.
    float spread = sqrt(seen.cosine_variance + t * t * floor_look.z * floor_look.z / 12.0 + 1e-6);
    WindowFacets facets = window_facets(seen, spread);
    // Facets lean in the plane of incidence.
    vec3 along = (ray - normal * cosine) / t;
    vec3 open = normalize(normal + along * ((facets.window - cosine) / t));
    float in_air = sqrt(max(1.0 - water_index * water_index * (1.0 - facets.window * facets.window), 0.0));
    vec3 out_of = normalize(water_index * ray + (in_air - water_index * facets.window) * open);
    // A tilt of a facet turns the refracted ray by n cos / cos' - 1 of it, and a mirrored ray by
    // twice the tilt.
    float turned = clamp(0.5 * (water_index * facets.window / max(in_air, 0.2) - 1.0), 0.0, 1.0);
    // Refraction into water narrows rays, which multiplies radiance by the square of the index.
    vec3 above = textureLod(sky, vec3(out_of.x, max(out_of.y, 0.01), out_of.z),
                            sqrt(turned * sqrt(alpha2)) * sky_irradiance.w).rgb * (water_index * water_index);
    vec3 closed = normalize(normal + along * ((facets.mirrors - cosine) / t));
    vec3 mirrored = seen_in_water(at, reflect(ray, closed), s);
    vec3 radiance = mix(mirrored, above, facets.transmitted) +
                    sunlight() * min(sun_through(normal, to_eye, alpha2), 3e3);
    vec3 diffuse = (sunlight_below() + skylight_below()) / pi;
    // Bubbles below the foam blur it, and colour its light along a path of a few metres.
    float cover = 0.7 * mix(foam.cover, foam.plume, 0.75);
    radiance = mix(radiance, (1.0 - foam_albedo(foam.thickness)) * diffuse, cover * mix(0.4, 0.95, foam.thickness));
    radiance = mix(radiance, 0.8 * diffuse * exp(-3.0 * attenuation_of_water()), 0.5 * foam.plume);
    return through_water(radiance, eye[EYE].xyz, ray, distance_m);
}
