// Light that comes out of the water. Morel and Prieur 1977 (colour of sea water).

// Light that comes up out of the water. Part of what goes down is scattered back before it is absorbed: 0.33 bb / (a +
// bb) of it in deep water (Morel and Prieur 1977). Over a bottom within sight its sand shines through, dimmed twice.
vec3 upwelling(float depth) {
    float sun_height = max(sun.y, 0.0);
    vec3 light_down = sun_irradiance.rgb * sun_height * (1.0 - mean_fresnel(sun_height, 0.15)) + 0.934 * sky_irradiance.rgb;
    vec3 absorption = water_absorption.rgb, scattering = water_scattering.rgb;
    vec3 reflectance = 0.33 * scattering / (absorption + scattering);
    vec3 through = exp(-2.0 * (absorption + scattering) * max(depth, 0.0));
    const vec3 sand = vec3(0.35, 0.31, 0.25);
    // 0.54: the surface's transmission and the widening of rays, t / n^2 (Austin 1974).
    return 0.54 * mix(reflectance, sand, through) * light_down / pi;
}

// Sunlight that enters a crest behind and leaves it towards the eye: the water's colour at its most saturated. The way
// through is short near the top of a high wave; scattering is strongly forwards.
vec3 through_crests(vec3 normal, vec3 to_eye, float height) {
    float crest = clamp(height / (0.75 * waves.x), 0.0, 1.0);
    float way = waves.x * mix(1.6, 0.25, crest);
    vec3 taken = exp(-(water_absorption.rgb + water_scattering.rgb) * way);
    float towards = dot(-to_eye, sun.xyz);
    const float g = 0.6;
    float phase = (1.0 - g * g) / (4.0 * pi * pow(1.0 + g * g - 2.0 * g * towards, 1.5));
    // Only faces that look at the eye and away from the sun are lit through.
    float faces = clamp(dot(normal, to_eye), 0.0, 1.0) * clamp(0.75 - 0.75 * dot(normal, sun.xyz), 0.0, 1.0);
    const float scattered_per_m = 0.25;
    float scattered = 1.0 - exp(-scattered_per_m * way);
    return sun_irradiance.rgb * taken * (phase * faces * scattered * crest * crest * 1.6) +
           sky_irradiance.rgb * taken * (0.03 * crest * crest * faces);
}
