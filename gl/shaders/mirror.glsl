// What the surface gives back of the light above it: the sky, and the sun's glint. A pixel's water is made of facets whose slopes have
// Gauss' distribution (Cox and Munk 1954) around the mean normal, of deviation s along each axis; alpha^2 = 2 s^2.
//
// Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces" (Beckmann's distribution, which is Gauss' of slopes);
// Heitz 2014, "Understanding the Masking-Shadowing Function"; Bruneton, Neyret and Holzschuch 2010, "Real-time Realistic Ocean
// Lighting using Seamless Transitions from Geometry to BRDF".
uniform highp samplerCube sky;  // level m: mirrored by alpha = (m / last)^2

// Unpolarised light from air to water, for the cosine at the facet.
float fresnel(float cosine) {
    const float index = 1.333;
    float g = sqrt(index * index - 1.0 + cosine * cosine);
    float a = (g - cosine) / (g + cosine), b = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

// The facets that an eye sees. It sees each by its projected area, max(mu + t x, 0), t being the sine of the angle between eye and
// mean normal, mu its cosine and x the slope towards the eye.
struct SeenFacets {
    float slope;            // mean slope towards the eye
    float cosine;           // mean cosine between eye and facet
    float cosine_variance;
};

// With a = mu / (s t), Gauss' density p and distribution P, and q = P / (a P + p) the mean slope is s q, the mean cosine mu + s t q, and
// its variance s^2 t^2 (2 - a q - q^2). At grazing angles the slope is 1.25 s: the far sea mirrors the sky well above the horizon.
SeenFacets seen_facets(float mu, float s) {
    float spread = max(s * sqrt(max(1.0 - mu * mu, 0.0)), 1e-4);
    float a = clamp(mu / spread, -3.0, 1e4);
    float density = 0.3989423 * exp(-0.5 * a * a);
    float distribution = 1.0 / (1.0 + exp(-1.5976 * a - 0.070566 * a * a * a));  // Page 1977, within 1.4e-4
    float q = distribution / max(a * distribution + density, 1e-4);
    return SeenFacets(s * q, mu + spread * q, spread * spread * max(2.0 - a * q - q * q, 0.0));
}

// Fresnel's mean over the facets that are seen: that of one facet a little more grazing than the mean one, because the curve is hollow.
// Facets of slope x stand at 1 / sqrt(1 + x^2) of the cosine. Within 3 % of the mean's integral for s up to 0.2.
float mean_fresnel(float cosine, float s) {
    SeenFacets seen = seen_facets(cosine, s);
    return fresnel(clamp(seen.cosine * (1.0 - s * s) - 2.5 * seen.cosine_variance, 0.0, 1.0));
}

// Smith's function for Beckmann's distribution (Walter et al. 2007, equation 15), times the cosine.
float masked_area(float cosine, float alpha) {
    float across = alpha * sqrt(max(1.0 - cosine * cosine, 1e-6));
    float a = cosine / across;
    return a < 1.6 ? across * (1.0 - 1.259 * a + 0.396 * a * a) / (3.535 + 2.181 * a) : 0.0;
}

// Part of light from a direction, of irradiance 1 across its rays, that one mirror of facets sends to the eye as radiance.
float mirrored_part(vec3 normal, vec3 to_eye, vec3 to_light, float alpha2) {
    float nl = dot(normal, to_light);
    if (nl <= 0.0) return 0.0;
    float nv = max(dot(normal, to_eye), 1e-3);
    vec3 middle = to_light + to_eye;
    middle /= max(length(middle), 1e-4);
    float cosine2 = clamp(dot(normal, middle), 1e-3, 1.0);
    cosine2 *= cosine2;
    float distribution = exp((cosine2 - 1.0) / (cosine2 * alpha2)) / (pi * alpha2 * cosine2 * cosine2);
    float alpha = sqrt(alpha2);
    float seen = nv + masked_area(nv, alpha) + masked_area(nl, alpha) * nv / nl;
    return distribution * fresnel(clamp(dot(middle, to_eye), 0.0, 1.0)) / (4.0 * seen);
}

// The sun's disc is narrower than any water's slopes.
float glint(vec3 normal, vec3 to_eye, float alpha2) { return mirrored_part(normal, to_eye, sun.xyz, alpha2); }

// The sky in the mean facet, weighted by what facets mirror: Fresnel's curve falls off as exp(-6 (1 - c^2) c) around a cosine c. The
// picture of the sky is as wide as the slopes of those facets make it, and narrower across, where grazing facets turn it little. 0.69: the
// levels' distribution is GGX, of which as many facets lean less.
vec3 mirrored_sky(vec3 normal, vec3 to_eye, float alpha2) {
    float mu = dot(normal, to_eye);
    vec3 along = to_eye - normal * mu;
    float t = max(length(along), 1e-4);
    float s = sqrt(0.5 * alpha2);
    SeenFacets seen = seen_facets(mu, s);
    float cosine = min(seen.cosine, 1.0);
    float slope = seen.slope - 6.0 * (1.0 - cosine * cosine) * seen.cosine_variance / t;
    vec3 reflected = reflect(-to_eye, normalize(normal + along / t * clamp(slope, 0.0, 1.5)));
    float in_plane = seen.cosine_variance / max(s * s * t * t, 1e-8);
    float width2 = 0.69 * alpha2 * 0.5 * (in_plane + cosine * cosine);
    return textureLod(sky, reflected, sqrt(sqrt(width2)) * sky_irradiance.w).rgb;
}
