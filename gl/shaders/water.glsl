// Light that leaves the water. Gordon 1973, "Simple calculation of the diffuse reflectance of the
// ocean"; Gordon et al. 1988, "A semianalytic radiance model of ocean color".
float cosine_in_water(float cosine) { return sqrt(1.0 - (1.0 - cosine * cosine) / (water_index * water_index)); }

// Returns the upwelling radiance above the surface, before the Fresnel transmittance is applied.
//
// Light of irradiance E on a level plane travels down with the cosine s in the water. Isotropic
// single scattering sends E / pi 0.5 bb / (a + bb) / (s + v) up with the cosine v. The factor 0.57
// instead of 0.5 includes multiple scattering. It gives 0.095 bb / (a + bb) of E straight down
// under a sun of 40 degrees, as in Gordon et al. 1988. Refraction at the surface widens the rays
// and divides radiance by the square of the index.
vec3 upwelling(vec3 normal, vec3 to_eye) {
    float seen = max(-refract(-to_eye, normal, 1.0 / water_index).y, 0.1);
    const float sky_in_water = 0.86;  // cosine in water for light of a uniform sky
    return 0.57 / (pi * water_index * water_index) * water_backscattering.rgb / attenuation_of_water() *
           (sunlight_below() / (cosine_in_water(max(sun.y, 0.0)) + seen) + skylight_below() / (sky_in_water + seen));
}

// Returns light that enters the back of a crest and leaves it towards the eye. The path through the
// crest is short near the top of a high wave, and scattering is strongly forward. A crest that
// begins to break is full of bubbles, which scatter much more than clear water.
vec3 through_crests(vec3 normal, vec3 to_eye, float height, float breaking) {
    float crest = clamp(height / (0.75 * waves.x), 0.0, 1.0);
    float path = waves.x * mix(1.6, 0.25, crest);
    vec3 taken = exp(-attenuation_of_water() * path);
    float towards = dot(-to_eye, sun.xyz);
    // Particles alone have g = 0.92. Refraction at both faces of the crest widens the lobe.
    float phase = henyey_greenstein(towards, 0.8);
    // Light passes through faces that point towards the eye and away from the sun.
    float faces = clamp(2.0 * dot(normal, to_eye), 0.0, 1.0) * clamp(0.75 - 0.75 * dot(normal, sun.xyz), 0.0, 1.0);
    float scattered = 1.0 - exp(-(water_scattering.g + 0.3 * breaking) * path);
    return taken * (crest * crest * faces * scattered) * (sun_irradiance.rgb * phase + sky_irradiance.rgb / (4.0 * pi));
}
