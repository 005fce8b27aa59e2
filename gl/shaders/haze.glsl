// Air between the sea and the eye.
//
// A path adds its source function times its absorptance. The source function is sunlight that air
// and haze scatter once, plus skylight that is uniform from above. It depends on the angle to the
// sun alone. Phase functions, albedo and scale heights are those of gl/sky/atmosphere.hpp.
const vec3 rayleigh_per_m = vec3(5.8e-6, 13.5e-6, 33.1e-6);

float rayleigh_phase(float cosine) { return 3.0 / (16.0 * pi) * (1.0 + cosine * cosine); }

// Cornette and Shanks 1992.
float haze_phase(float cosine) {
    const float g = 0.76;
    return 3.0 / (8.0 * pi) * (1.0 - g * g) * (1.0 + cosine * cosine) /
           ((2.0 + g * g) * pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
}

// Returns the mean density between the sea and a height, relative to the density at the sea.
float thinned(float height, float scale_height) {
    float x = max(abs(height), 1.0) / scale_height;
    return (1.0 - exp(-x)) / x;
}

vec3 through_haze(vec3 radiance, vec3 from_eye, float distance_m) {
    vec3 ray = from_eye / distance_m;
    float height = viewer.z + eye[EYE].y;
    vec3 air = rayleigh_per_m * thinned(height, 8000.0);
    vec3 taken = air + (haze.rgb - rayleigh_per_m) * thinned(height, 1200.0) +
                 viewer.y * thinned(height, 1.0 + 0.5 * waves.x);  // spindrift, as high as half a wave
    vec3 by_haze = 0.9 * (taken - air);
    float to_sun = dot(ray, sun.xyz);
    vec3 source = (cloud_light.x * sun_irradiance.rgb * (air * rayleigh_phase(to_sun) + by_haze * haze_phase(to_sun)) +
                   sky_irradiance.rgb / (2.0 * pi) * (air + by_haze)) / taken;
    // At the horizon dense haze has the colour of the sky there, so that no line separates the two.
    // Further down the azimuth becomes undefined, and the sky's weight falls to 0. Its clouds must
    // not show on the haze.
    float at_horizon = exp(-100.0 * ray.y * ray.y);
    vec3 horizon = textureLod(sky, vec3(ray.x, 0.01 * ray.y * ray.y, ray.z), 4.0 * (1.0 - at_horizon)).rgb;
    // The second factor softens the last fraction of a degree, in which rows of pixels are
    // kilometres apart.
    float soft = distance_m / haze.w;
    vec3 transmittance = exp(-taken * distance_m) * exp(-soft * soft);
    return mix(mix(source, horizon, at_horizon), radiance, transmittance);
}
