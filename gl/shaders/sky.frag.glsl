// Background: the baked sky, stars and the disc of the sun or the moon, or the water where the lens
// is under water.
#ifdef MULTIVIEW
#extension GL_OVR_multiview2 : require
#endif
precision highp float;
precision highp int;
#include "scene.glsl"
#include "tone.glsl"
#include "stars.glsl"

in vec3 ray;
out vec4 colour;

const float pi = 3.14159265;

#if BELOW
#include "lens.glsl"
#include "mirror.glsl"
#include "caustics.glsl"
#include "water_light.glsl"
#include "under_water.glsl"
#else
uniform highp samplerCube sky;
#endif

// Returns the limb darkening of the sun, 1 - 0.6 (1 - cosine), a common fit for visible light. 0.8
// is its mean over the disc.
float sun_shading(float off_centre) {
    return (0.4 + 0.6 * sqrt(max(0.0, 1.0 - off_centre * off_centre))) / 0.8;
}

// Returns the brightness of the moon's disc. Like dust, it is uniform where the sun lights the
// moon.
float moon_shading(vec3 from_centre) {
    float off_centre = length(from_centre);
    vec3 normal = from_centre - sun.xyz * sqrt(max(0.0, 1.0 - off_centre * off_centre));
    return smoothstep(-0.05, 0.05, dot(normal, moon.xyz)) / moon.w;
}

void main() {
    vec3 direction = normalize(ray);
#if BELOW
    float above = lens_above_water(ray);
    if (above < 0.0) {
        // Rays that lead upwards hit the surface, except for rays that just miss it.
        vec3 level = normalize(vec3(direction.x, min(direction.y, -0.001), direction.z));
        vec3 water = through_water(vec3(0.0), eye[EYE].xyz, level, 1e4);
        colour = screen_colour(across_meniscus(water, above));
        return;
    }
    if (viewer.x < 0.5) discard;
#endif
    // Below the horizon the sea covers the background. Where an application draws no sea, the sky
    // at the horizon is extended.
    vec4 baked = textureLod(sky, vec3(direction.x, max(direction.y, 0.0), direction.z), 0.0);
    vec3 radiance = baked.rgb;
    float risen = smoothstep(-0.002, 0.0, direction.y);
    vec3 from_centre = (direction - sun.xyz) / sun.w;
    float off_centre = length(from_centre);
    float edge = max(fwidth(off_centre), 0.02);
    float disc = 1.0 - smoothstep(1.0 - edge, 1.0 + edge, off_centre);
    // 0.25: optical depth of the air at the zenith; the path lengthens towards the horizon.
    if (stars.x > 0.0)
        radiance += starlight(direction) * (risen * (1.0 - disc) * baked.a * exp(-0.25 / max(direction.y, 0.03)));
    float shading = moon.w > 0.0 ? moon_shading(from_centre) : sun_shading(off_centre);
    float clouds = cloud_light.y > 0.0 ? min(baked.a * cloud_light.y, 1.0) : 1.0;
    radiance += sun_irradiance.rgb * (disc * shading / (3.14159265 * sun.w * sun.w)) * (risen * clouds);
    radiance = min(radiance, vec3(6e4));
#if BELOW
    radiance = across_meniscus(radiance, above);
#endif
    colour = screen_colour(radiance);
}
