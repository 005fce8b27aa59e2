// Reflection of the sky and glint of the sun. The water in a pixel consists of facets whose slopes
// have a Gaussian distribution (Cox and Munk 1954) around the mean normal, with standard deviation
// s along each axis; alpha^2 = 2 s^2.
//
// Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces" (Beckmann's
// distribution, which is Gaussian in slopes); Heitz 2014, "Understanding the Masking-Shadowing
// Function"; Bruneton, Neyret and Holzschuch 2010, "Real-time Realistic Ocean Lighting using
// Seamless Transitions from Geometry to BRDF".
uniform highp samplerCube sky;  // level m: reflection with alpha = (m / last)^2

// Returns the Fresnel reflectance of unpolarised light from air to water. `cosine` is the cosine of
// incidence at a facet.
float fresnel(float cosine) {
    const float index = 1.333;
    float g = sqrt(index * index - 1.0 + cosine * cosine);
    float a = (g - cosine) / (g + cosine), b = (cosine * (g + cosine) - 1.0) / (cosine * (g - cosine) + 1.0);
    return 0.5 * a * a * (1.0 + b * b);
}

// Facets visible to the eye. Each is weighted by its projected area, max(mu + t x, 0). Here mu and
// t are the cosine and the sine of the angle between eye and mean normal, and x is the slope
// towards the eye.
struct SeenFacets {
    float slope;            // mean slope towards the eye
    float cosine;           // mean cosine between eye and facet
    float cosine_variance;
};

// Let a = mu / (s t), p and P the Gaussian density and distribution, and q = P / (a P + p). The
// mean slope is s q, the mean cosine mu + s t q, and its variance s^2 t^2 (2 - a q - q^2). At
// grazing angles the mean slope is 1.25 s, so the distant sea reflects the sky well above the
// horizon.
SeenFacets seen_facets(float mu, float s) {
    float spread = max(s * sqrt(max(1.0 - mu * mu, 0.0)), 1e-4);
    float a = clamp(mu / spread, -2.0, 1e4);  // below, the approximations fail
    float density = 0.3989423 * exp(-0.5 * a * a);
    // Page 1977, with an error of at most 1.4e-4.
    float distribution = 1.0 / (1.0 + exp(-1.5976 * a - 0.070566 * a * a * a));
    float q = distribution / max(a * distribution + density, 1e-4);
    return SeenFacets(s * q, spread * (a + q), spread * spread * max(2.0 - a * q - q * q, 0.0));
}

// Returns the mean Fresnel reflectance of the visible facets. It is that of one facet slightly more
// grazing than the mean facet, because the curve is convex. Facets of slope x have
// 1 / sqrt(1 + x^2) of the cosine. The error is at most 4 % of the integral for s up to 0.2.
float mean_fresnel(float cosine, float s) {
    SeenFacets seen = seen_facets(cosine, s);
    return fresnel(clamp(seen.cosine * (1.0 - 1.2 * s * s) - 2.5 * seen.cosine_variance, 0.0, 1.0));
}

// Returns Smith's function for Beckmann's distribution (Walter et al. 2007, equation 15), times the
// cosine.
float masked_area(float cosine, float alpha) {
    float across = alpha * sqrt(max(1.0 - cosine * cosine, 1e-6));
    float a = cosine / across;
    return a < 1.6 ? across * (1.0 - 1.259 * a + 0.396 * a * a) / (3.535 + 2.181 * a) : 0.0;
}

// Returns the fraction of the visible water that no other wave shadows, from the elevations of eye
// and light over the flat sea. It is (1 + V) / (1 + V + L), where V and L are Smith's functions of
// eye and light (Heitz 2014, equation 99). It includes all waves, because waves that a pixel
// resolves also hide the sun and the sky from each other.
float lit_fraction(float eye_cosine, float light_cosine, float alpha_of_all) {
    float eye_height = max(eye_cosine, 1e-3), light_height = max(light_cosine, 1e-4);
    float seen = (eye_height + masked_area(eye_height, alpha_of_all)) * light_height;
    return seen / (seen + masked_area(light_height, alpha_of_all) * eye_height);
}

// Returns alpha of all waves.
float alpha_of_all_waves() {
    float square = waves.y * waves.y;
    for (int cascade = 0; cascade < CASCADES; ++cascade) square += cascade_slope[cascade].z;
    return sqrt(square);
}

// Returns the mean square slope of the waves that the mesh resolves at a distance. Octaves of a
// cascade have equal variances, and a mesh needs vertices twice as dense as texels.
float slopes_of_mesh(float distance_m) {
    float spacing = max(mesh.y, distance_m * mesh.x), square = 0.0;
    for (int cascade = 0; cascade < CASCADES; ++cascade) {
        float mip = max(log2(spacing * cascade_scale[cascade].x) - 0.5, 0.0);
        square += cascade_slope[cascade].z * clamp(1.0 - (mip + 1.0) / cascade_scale[cascade].y, 0.0, 1.0);
    }
    return square;
}

// Corrects the normal for projected area. Waves that are in the normal but not in the mesh are
// drawn as if they were flat: facets that face away from the eye have the same weight as facets
// that face it. The slopes of the normal relative to the mesh have a Gaussian distribution. They
// are mapped to the quantiles of the visible facets, approximated by mean and standard deviation.
vec3 seen_normal(vec3 normal, vec3 facet, vec3 to_eye, float alpha2, float distance_m) {
    float all = alpha_of_all_waves();
    float s = sqrt(0.5 * max(all * all - alpha2 - slopes_of_mesh(distance_m), 1e-6));
    vec2 plane = facet.xz / facet.y;
    vec2 slopes = normal.xz / normal.y - plane;
    vec2 towards = to_eye.xz / max(length(to_eye.xz), 1e-4);
    float mu = dot(facet, to_eye);
    if (mu <= 0.0) return normal;  // seen from below, or the back of a crest
    SeenFacets seen = seen_facets(mu, s);
    float narrowed = sqrt(seen.cosine_variance) / max(s * sqrt(max(1.0 - mu * mu, 0.0)), 1e-4);
    float lean = dot(slopes, towards);
    slopes += towards * (seen.slope + lean * (min(narrowed, 1.0) - 1.0));
    return normalize(vec3(plane.x + slopes.x, 1.0, plane.y + slopes.y));
}

// Returns the radiance that a pixel's facets reflect to the eye, for light from a direction with
// irradiance 1 perpendicular to its rays.
float mirrored_fraction(vec3 normal, vec3 to_eye, vec3 to_light, float alpha2, float alpha_of_all) {
    if (dot(normal, to_light) <= 0.0) return 0.0;
    vec3 middle = to_light + to_eye;
    middle /= max(length(middle), 1e-4);
    float cosine2 = clamp(dot(normal, middle), 1e-3, 1.0);
    cosine2 *= cosine2;
    float distribution = exp((cosine2 - 1.0) / (cosine2 * alpha2)) / (pi * alpha2 * cosine2 * cosine2);
    float nv = max(dot(normal, to_eye), 1e-3);
    return distribution * fresnel(clamp(dot(middle, to_eye), 0.0, 1.0)) *
           lit_fraction(to_eye.y, to_light.y, alpha_of_all) / (4.0 * (nv + masked_area(nv, sqrt(alpha2))));
}

// Returns the glint of the sun. The disc is treated as a point, because it is narrower than the
// distribution of slopes.
float glint(vec3 normal, vec3 to_eye, float alpha2) {
    return mirrored_fraction(normal, to_eye, sun.xyz, alpha2, alpha_of_all_waves());
}

// Reflection of the sky in the facets of a pixel.
struct MeanMirror {
    vec3 towards;     // mean direction of the sky that is reflected
    float alpha2;     // alpha^2 of a mirror that blurs equally
    float sky_share;  // share of the reflected light that is the sky's; the rest is light of water
    float lit;        // share of the reflected rays that reach the sky without meeting a wave
};

// Returns the reflection of a ray at a wave that it meets, whose facets are those that the ray
// sees. xyz: direction of the sky that is reflected; w: reflectance. A ray that rises meets the
// faces of crests, whose mean cosine is negative on the level sea.
vec4 reflection_at_wave(vec3 towards, float alpha_of_all) {
    float s = alpha_of_all * sqrt(0.5);
    SeenFacets seen = seen_facets(-towards.y, s);
    vec2 ahead = towards.xz / max(length(towards.xz), 1e-4);
    vec3 out_of = reflect(towards, normalize(vec3(-ahead.x * seen.slope, 1.0, -ahead.y * seen.slope)));
    return vec4(out_of.x, max(out_of.y, 0.02), out_of.z,
                fresnel(clamp(seen.cosine * (1.0 - 1.2 * s * s) - 2.5 * seen.cosine_variance, 0.0, 1.0)));
}

// Around a cosine c the Fresnel curve falls off as exp(-6 (1 - c^2) c), which weights the slopes.
// The visible facets' slopes determine the width of the reflected image. Perpendicular to the plane
// of incidence it is narrower, because grazing facets deflect it little. The factor 0.69 matches
// the median slope to that of the sky's levels, which have a GGX distribution. A ray that hits
// another wave is reflected a second time there. One sample of the sky serves both reflections, in
// the mean of their directions.
MeanMirror mean_mirror(vec3 normal, vec3 to_eye, float alpha2, float alpha_of_all) {
    float mu = dot(normal, to_eye);
    vec3 along = to_eye - normal * mu;
    float t = max(length(along), 1e-4);
    float s = sqrt(0.5 * alpha2);
    SeenFacets seen = seen_facets(mu, s);
    float cosine = min(seen.cosine, 1.0);
    float slope = seen.slope - 6.0 * (1.0 - cosine * cosine) * seen.cosine_variance / t;
    vec3 towards = reflect(-to_eye, normalize(normal + along / t * clamp(slope, 0.0, 1.5)));
    float in_plane = seen.cosine_variance / max(s * s * t * t, 1e-8);
    // Within a pixel, the mean of the facets' lit fractions is smaller than that of the mean facet.
    // The factor is fitted to the integral.
    float x = max(mu, 0.0) / sqrt(alpha2);
    float lit = lit_fraction(to_eye.y, towards.y, alpha_of_all) * (1.0 - (0.1 + 0.3 * sqrt(alpha2)) * x * exp((1.0 - x * sqrt(x)) / 1.5));
    vec4 second = reflection_at_wave(towards, alpha_of_all);
    return MeanMirror(mix(second.xyz, towards, lit), 0.69 * alpha2 * 0.5 * (in_plane + cosine * cosine),
                      mix(second.w, 1.0, lit), lit);
}

// Returns the reflected light of a pixel. `water_light` is the radiance of other waves without
// their reflection.
vec3 mirrored_light(vec3 normal, vec3 to_eye, float alpha2, vec3 water_light) {
    MeanMirror mirror = mean_mirror(normal, to_eye, alpha2, alpha_of_all_waves());
    vec3 light = textureLod(sky, mirror.towards, sqrt(sqrt(mirror.alpha2)) * sky_irradiance.w).rgb;
    return mix(water_light, light, mirror.sky_share);
}
