// Light that leaves the water. Gordon 1973, "Simple calculation of the diffuse reflectance of the
// ocean"; Gordon et al. 1988, "A semianalytic radiance model of ocean color".
float cosine_in_water(float cosine) { return sqrt(1.0 - (1.0 - cosine * cosine) / (water_index * water_index)); }

// Normal of the long waves alone, which main() sets.
vec3 long_wave_normal = vec3(0.0, 1.0, 0.0);

// Returns the upwelling radiance above the surface, before the Fresnel transmittance is applied.
//
// Light of irradiance E on a level plane travels down with the cosine s in the water. Isotropic
// single scattering sends E / pi 0.5 bb / (a + bb) / (s + v) up with the cosine v. The factor 0.57
// instead of 0.5 includes multiple scattering. It gives 0.095 bb / (a + bb) of E straight down
// under a sun of 40 degrees, as in Gordon et al. 1988. Refraction at the surface widens the rays
// and divides radiance by the square of the index.
//
// Light comes back from metres below, so the sides of waves longer than about 12 m receive the
// sunlight of their slope, and shorter waves that of the level sea.
vec3 upwelling(vec3 normal, vec3 to_eye) {
    float seen = max(-refract(-to_eye, normal, 1.0 / water_index).y, 0.1);
    const float sky_in_water = 0.86;  // cosine in water for light of a uniform sky
    return 0.57 / (pi * water_index * water_index) * water_backscattering.rgb / attenuation_of_water() *
           (sunlight_into(long_wave_normal) / (cosine_in_water(max(sun.y, 0.0)) + seen) +
            skylight_below() / (sky_in_water + seen));
}

// Returns the light of a face that is turned away from the sun, in excess of upwelling(), before
// the Fresnel transmittance is applied. A flat sea has none.
//
// Sunlight enters the wave from behind, along crest_ray, and is scattered once towards the eye. At
// the angle A, away from the forward peak, the phase function of Henyey and Greenstein is nearly
// 0.096 bb / sin^3(A / 2), where bb is the backscattering: the asymmetry cancels. upwelling() has
// 0.18 bb of it. The ray from the eye runs about parallel to the back of the wave, so all points of
// the ray are about equally lit, and the integral over the ray is 1 / (a + bb). It is less where
// the ray leaves a short wave through its back. crest_sun has the factors that are uniform
// (place_crest_light() of gl/water/scene_block.cpp).
//
// Sunlight reaches the face from the level of the crest. Heights of crests have a Rayleigh
// distribution, whose mean is 0.31 times the significant wave height.
//
// The constants of the path fit docs/images/reference/crest_light.csv. A lip that is about to break
// (`lip`, 0 to 1) is thin and full of bubbles, and light crosses about 1.5 m of its water. Steep faces
// are thin. The factor is fitted to a requirement: in a gale the top fifth of a crest passes twice the
// light of half its height.
vec3 through_crests(vec3 normal, vec3 to_eye, float height, float lip) {
    float steep = dot(normal.xz, crest_ray.xz), away = clamp(6.0 * steep, 0.0, 1.0);
    lip *= clamp(2.5 * steep, 0.0, 1.0);
    float narrow = max(1.0 + dot(refract(-to_eye, normal, 1.0 / water_index), crest_ray.xyz), 0.1);
    float scattered = max(0.27 * inversesqrt(narrow * narrow * narrow) - 0.18, 0.0);
    float depth = max(0.31 * waves.x - height, 0.0);
    vec3 k = attenuation_of_water();
    vec3 path = min(0.6 + 0.7 * waves.x * k, 1.0) / k;
    return away * (water_backscattering.rgb * path * exp(k * (depth * crest_ray.w)) + 2.7 * lip * exp(-1.5 * k)) *
           (scattered * sunlit * crest_sun.rgb + crest_sky.rgb);
}
