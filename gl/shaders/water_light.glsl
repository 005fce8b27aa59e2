// Light within the water: attenuation of sunlight and skylight with depth, and in-scattering
// towards the eye.
//
// Attenuation is the sum of absorption and backscattering, both for downwelling light and along the
// view ray, so that deep water has the colour of upwelling(). Scattering at small angles hardly
// deflects light. By the delta approximation (Joseph, Wiscombe and Weinman 1976) the remainder is a
// Henyey-Greenstein lobe of g' = g / (1 + g) = 0.48 for sea water's g = 0.92 (Petzold 1972). The
// scattering coefficient of the lobe is 9.5 times the backscattering. Straight down under a high
// sun this gives 0.29 bb / (a + bb) of the light, as in upwelling().
const float water_index = 1.333;

vec3 attenuation_of_water() { return water_absorption.rgb + water_backscattering.rgb; }

// Returns the direction towards the sun in the water, by Snell's law at a level surface.
vec3 sun_in_water() {
    vec2 across = sun.xz / water_index;
    return vec3(across.x, sqrt(1.0 - dot(across, across)), across.y);
}

// Returns the fraction of the sun's irradiance that enters a plane, which may be the side of a long wave.
float enters(vec3 normal) {
    float high = max(dot(normal, sun.xyz), 0.0);
    return high * (1.0 - mean_fresnel(high, 0.15));
}
vec3 sunlight_into(vec3 normal) { return sunlight() * enters(normal); }

// Irradiance just below the surface, on a level plane.
vec3 sunlight_below() { return sunlight_into(vec3(0.0, 1.0, 0.0)); }
vec3 skylight_below() { return 0.934 * sky_irradiance.rgb; }

float henyey_greenstein(float cosine, float g) {
    return (1.0 - g * g) / (4.0 * pi * pow(1.0 + g * g - 2.0 * g * cosine, 1.5));
}

// Returns the light that water scatters towards an eye `depth` metres below the surface, along
// `path` metres of a ray. The integral of exp(-k s) exp(-k (depth - s ray.y)) over the ray has a
// closed form. `shafts` is the mean sunlight along the ray, relative to sunlight without caustics.
// What is seen is near, so all of it is lit as the sea at the viewer: surface, floor and background meet
// without a line.
vec3 scattered_light(vec3 ray, float depth, float path, float shafts) {
    const float lobe = 0.48, amount = 9.5;
    vec3 k = attenuation_of_water();
    vec3 x = max(k * (path * (1.0 - min(ray.y, 1.0))), 1e-3);
    vec3 seen = path * (1.0 - exp(-x)) / x;
    vec3 to_sun = sun_in_water();
    float entering = cloud_light.z * enters(vec3(0.0, 1.0, 0.0)) / to_sun.y;
    vec3 from_sun = entering * sun_irradiance.rgb * exp(-k * depth / to_sun.y);
    vec3 from_sky = skylight_below() * exp(-k * depth);
    return amount * water_backscattering.rgb * seen *
           (from_sun * (shafts * henyey_greenstein(dot(ray, to_sun), lobe)) +
            from_sky * henyey_greenstein(ray.y, lobe));
}

// Returns the depth below the still-water level of a position relative to the viewer.
float depth_of(vec3 at) { return max(-(at.y + viewer.z), 0.0); }
