// Light within the water: what is left of sunlight and skylight at a depth, and what the water scatters towards the eye.
//
// Attenuation is the sum of absorption and backscattering, for light that comes down and for what is seen alike, so that deep
// water has the colour that upwelling() gives it. Scattering at small angles hardly turns light: the rest of it, by the
// delta approximation (Joseph, Wiscombe and Weinman 1976), is a Henyey-Greenstein lobe of g' = g / (1 + g) = 0.48 for sea water's
// g = 0.92 (Petzold 1972). Its amount is 9.5 times the backscattering: straight down under a high sun that is 0.29 bb / (a + bb) of
// the light, as upwelling() has it.
const float water_index = 1.333;

vec3 attenuation_of_water() { return water_absorption.rgb + water_backscattering.rgb; }

// Towards the sun, by Snell's law at level water.
vec3 sun_in_water() {
    vec2 across = sun.xz / water_index;
    return vec3(across.x, sqrt(1.0 - dot(across, across)), across.y);
}

// Just below the surface, on a level plane.
vec3 sunlight_below() {
    float high = max(sun.y, 0.0);
    return sun_irradiance.rgb * high * (1.0 - mean_fresnel(high, 0.15));
}
vec3 skylight_below() { return 0.934 * sky_irradiance.rgb; }

float henyey_greenstein(float cosine, float g) {
    return (1.0 - g * g) / (4.0 * pi * pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
}

// What water scatters towards an eye `depth` below the surface, along `way` metres of a ray. Light falls off with depth and with
// the way, so the integral of exp(-k s) exp(-k (depth - s ray.y)) is closed. `shafts` is the sun's part of its mean along the ray.
vec3 scattered_light(vec3 ray, float depth, float way, float shafts) {
    const float lobe = 0.48, amount = 9.5;
    vec3 k = attenuation_of_water();
    vec3 x = max(k * (way * (1.0 - min(ray.y, 1.0))), 1e-3);
    vec3 seen = way * (1.0 - exp(-x)) / x;
    vec3 to_sun = sun_in_water();
    vec3 from_sun = sunlight_below() / to_sun.y * exp(-k * depth / to_sun.y);
    vec3 from_sky = skylight_below() * exp(-k * depth);
    return amount * water_backscattering.rgb * seen *
           (from_sun * (shafts * henyey_greenstein(dot(ray, to_sun), lobe)) +
            from_sky * henyey_greenstein(ray.y, lobe));
}

// Depth below rest of a place relative to the viewer.
float depth_of(vec3 at) { return max(-(at.y + viewer.z), 0.0); }
