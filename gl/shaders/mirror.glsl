// What the surface gives back of the light above it: the sky, and the sun's glint.
//
// Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering"; Walter et al. 2007 (GGX); Heitz 2014, "Understanding
// the Masking-Shadowing Function"; Bruneton, Neyret and Holzschuch 2010, "Real-time Realistic Ocean Lighting using Seamless
// Transitions from Geometry to BRDF".
uniform highp samplerCube sky;  // level m: mirrored by alpha = (m / last)^2

const float water_f0 = 0.02;  // ((1.333 - 1) / (1.333 + 1))^2

// The mean normal of the waves that an eye sees. Of slopes with deviation s around the mean, those that lean towards
// the eye show more of themselves, in proportion to their projected area, max(mu + s_v tan, 0); the mean slope towards
// the eye under this weight is s^2 t P(a) / (mu P(a) + s t p(a)), a = mu / (s t), with Gauss' density p and
// distribution P. At grazing angles this is 1.25 s: the far sea mirrors the sky well above the horizon.
vec3 visible_normal(vec3 normal, vec3 to_eye, float alpha2) {
    float mu = dot(normal, to_eye);
    vec3 along = to_eye - normal * mu;
    float t = max(length(along), 1e-4);
    float s = sqrt(0.5 * alpha2);
    float a = clamp(mu / (s * t), -3.0, 12.0);
    float density = 0.3989423 * exp(-0.5 * a * a);
    float distribution = 1.0 / (1.0 + exp(-1.5976 * a - 0.070566 * a * a * a));  // Page 1977, within 1.4e-4
    float slope = s * distribution / max(a * distribution + density, 1e-4);
    return normalize(normal + along / t * min(slope, 1.5));
}

// Schlick's curve, averaged over slopes of deviation s: Bruneton et al. 2010, equation 16.
float mean_fresnel(float cosine, float s) {
    float grazing = pow(1.0 - cosine, 5.0 * exp(-2.69 * s)) / (1.0 + 22.7 * pow(s, 1.5));
    return water_f0 + (1.0 - water_f0) * grazing;
}

// GGX with Smith's height-correlated masking (Heitz 2014), times the cosine of the light.
float glint(vec3 normal, vec3 to_eye, float alpha2) {
    float nl = dot(normal, sun.xyz);
    if (nl <= 0.0) return 0.0;
    float nv = max(dot(normal, to_eye), 0.01);
    vec3 middle = normalize(sun.xyz + to_eye);
    float nh = max(dot(normal, middle), 0.0);
    alpha2 += 4.0 * sun.w * sun.w;  // the disc is not a point
    float d = nh * nh * (alpha2 - 1.0) + 1.0;
    float distribution = alpha2 / (pi * d * d);
    float visibility =
        0.5 / (nl * sqrt(nv * nv * (1.0 - alpha2) + alpha2) + nv * sqrt(nl * nl * (1.0 - alpha2) + alpha2));
    float fresnel = water_f0 + (1.0 - water_f0) * pow(1.0 - max(dot(middle, to_eye), 0.0), 5.0);
    return distribution * visibility * fresnel * nl;
}

vec3 mirrored_sky(vec3 normal, vec3 to_eye, float alpha2) {
    vec3 reflected = reflect(-to_eye, visible_normal(normal, to_eye, alpha2));
    return textureLod(sky, reflected, sqrt(sqrt(alpha2)) * sky_irradiance.w).rgb;
}
