// Light that comes out of the water. Gordon 1973, "Simple calculation of the diffuse reflectance of the ocean"; Morel and Prieur
// 1977 (colour of sea water); Kirk 1984 (the sun's height).
const float air_over_water = 0.75;  // of the indices of refraction, 1 / 1.333

float cosine_in_water(float cosine) { return sqrt(1.0 - (1.0 - cosine * cosine) * (air_over_water * air_over_water)); }

// Radiance that comes up through the surface, as it is on the eye's side of it before Fresnel takes his part. Light that goes down with
// the cosine s in the water, of irradiance E on a level plane, and is scattered upwards once and evenly, leaves with the cosine v as E / pi 0.5 bb /
// (a + bb) / (s + v); what is scattered more often makes 0.66 of the 0.5, and so 0.33 bb / (a + bb) of light that comes and
// is seen straight through (Morel and Prieur 1977). Crossing the surface widens its rays, which thins radiance by the square of the index.
// Over a bottom within sight its sand shines through, dimmed on both ways.
vec3 upwelling(vec3 normal, vec3 to_eye, float depth) {
    float seen = max(-refract(-to_eye, normal, air_over_water).y, 0.1);
    float sun_height = max(sun.y, 0.0);
    float sun_in_water = cosine_in_water(sun_height);
    const float sky_in_water = 0.86;  // of an even sky
    vec3 of_sun = sun_irradiance.rgb * (sun_height * (1.0 - mean_fresnel(sun_height, 0.15)));
    vec3 of_sky = 0.934 * sky_irradiance.rgb;
    vec3 attenuation = water_absorption.rgb + water_backscattering.rgb;
    vec3 deep = 0.66 * water_backscattering.rgb / attenuation * (of_sun / (sun_in_water + seen) + of_sky / (sky_in_water + seen));
    vec3 way = attenuation * max(depth, 0.0);
    const vec3 sand = vec3(0.35, 0.31, 0.25);
    vec3 bottom = sand * (of_sun * exp(-way / sun_in_water) + of_sky * exp(-way / sky_in_water));
    return air_over_water * air_over_water / pi * mix(deep, bottom, exp(-way / seen));
}

// Sunlight that enters a crest behind and leaves it towards the eye: the water's colour at its most saturated. The way
// through is short near the top of a high wave; scattering is strongly forwards. Where a crest begins to break it is full of
// bubbles, which scatter many times what clear water does.
vec3 through_crests(vec3 normal, vec3 to_eye, float height, float breaking) {
    float crest = clamp(height / (0.75 * waves.x), 0.0, 1.0);
    float way = waves.x * mix(1.6, 0.25, crest);
    vec3 taken = exp(-(water_absorption.rgb + water_backscattering.rgb) * way);
    float towards = dot(-to_eye, sun.xyz);
    // Henyey and Greenstein 1941. Particles alone have 0.92; the crest's two faces spread the light as well.
    const float g = 0.8;
    float phase = (1.0 - g * g) / (4.0 * pi * pow(1.0 + g * g - 2.0 * g * towards, 1.5));
    // Only faces that look at the eye and away from the sun are lit through.
    float faces = clamp(2.0 * dot(normal, to_eye), 0.0, 1.0) * clamp(0.75 - 0.75 * dot(normal, sun.xyz), 0.0, 1.0);
    float scattered = 1.0 - exp(-(water_scattering.g + 0.3 * breaking) * way);
    return taken * (crest * crest * faces * scattered) * (sun_irradiance.rgb * phase + sky_irradiance.rgb / (4.0 * pi));
}
