// Light that comes out of the water. Gordon 1973, "Simple calculation of the diffuse reflectance of the ocean"; Gordon et al. 1988, "A
// semianalytic radiance model of ocean color".
float cosine_in_water(float cosine) { return sqrt(1.0 - (1.0 - cosine * cosine) / (water_index * water_index)); }

// Radiance that comes up through the surface, as it is on the eye's side of it before Fresnel takes his part. Light that goes down with
// the cosine s in the water, of irradiance E on a level plane, and is scattered upwards once and evenly, leaves with the cosine v as
// E / pi 0.5 bb / (a + bb) / (s + v). With 0.57, what is scattered more often counted, it is 0.095 bb / (a + bb) of E straight down under a
// sun of 40 degrees, as Gordon et al. 1988 have it. Crossing the surface widens its rays, which thins radiance by the square of the index.
vec3 upwelling(vec3 normal, vec3 to_eye) {
    float seen = max(-refract(-to_eye, normal, 1.0 / water_index).y, 0.1);
    const float sky_in_water = 0.86;  // the cosine of an even sky's light
    return 0.57 / (pi * water_index * water_index) * water_backscattering.rgb / attenuation_of_water() *
           (sunlight_below() / (cosine_in_water(max(sun.y, 0.0)) + seen) + skylight_below() / (sky_in_water + seen));
}

// Sunlight that enters a crest behind and leaves it towards the eye: the water's colour at its most saturated. The way
// through is short near the top of a high wave; scattering is strongly forwards. Where a crest begins to break it is full of
// bubbles, which scatter many times what clear water does.
vec3 through_crests(vec3 normal, vec3 to_eye, float height, float breaking) {
    float crest = clamp(height / (0.75 * waves.x), 0.0, 1.0);
    float way = waves.x * mix(1.6, 0.25, crest);
    vec3 taken = exp(-attenuation_of_water() * way);
    float towards = dot(-to_eye, sun.xyz);
    // Particles alone have 0.92; the crest's two faces spread the light as well.
    float phase = henyey_greenstein(towards, 0.8);
    // Only faces that look at the eye and away from the sun are lit through.
    float faces = clamp(2.0 * dot(normal, to_eye), 0.0, 1.0) * clamp(0.75 - 0.75 * dot(normal, sun.xyz), 0.0, 1.0);
    float scattered = 1.0 - exp(-(water_scattering.g + 0.3 * breaking) * way);
    return taken * (crest * crest * faces * scattered) * (sun_irradiance.rgb * phase + sky_irradiance.rgb / (4.0 * pi));
}
