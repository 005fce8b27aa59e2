// What is behind the sea: the baked sky, stars and the disc of the sun or the moon, or the water itself where the lens is within it.
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

// Of the sun: darker towards the limb, 1 - 0.6 (1 - cosine), the classic fit for visible light. 0.8 is its mean over the disc.
float sun_shading(float off_centre) {
    return (0.4 + 0.6 * sqrt(max(0.0, 1.0 - off_centre * off_centre))) / 0.8;
}

// Of the moon: as bright all over as dust is, where the sun lights it.
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
        // Upwards there is the surface, but for rays that just miss it.
        vec3 level = normalize(vec3(direction.x, min(direction.y, -0.001), direction.z));
        vec3 water = through_water(vec3(0.0), eye[EYE].xyz, level, 1e4);
        colour = screen_colour(across_meniscus(water, above));
        return;
    }
    if (viewer.x < 0.5) discard;
#endif
    // Under the horizon lies the sea; where an application draws none, the horizon goes on.
    vec4 baked = textureLod(sky, vec3(direction.x, max(direction.y, 0.0), direction.z), 0.0);
    vec3 radiance = baked.rgb;
    float risen = smoothstep(-0.002, 0.0, direction.y);
    vec3 from_centre = (direction - sun.xyz) / sun.w;
    float off_centre = length(from_centre);
    float edge = max(fwidth(off_centre), 0.02);
    float disc = 1.0 - smoothstep(1.0 - edge, 1.0 + edge, off_centre);
    // 0.25: the air's depth at the zenith; the path grows towards the horizon.
    if (stars.x > 0.0)
        radiance += starlight(direction) * (risen * (1.0 - disc) * baked.a * exp(-0.25 / max(direction.y, 0.03)));
    float shading = moon.w > 0.0 ? moon_shading(from_centre) : sun_shading(off_centre);
    radiance += sun_irradiance.rgb * (disc * shading / (3.14159265 * sun.w * sun.w)) * risen;
    radiance = min(radiance, vec3(6e4));
#if BELOW
    radiance = across_meniscus(radiance, above);
#endif
    colour = screen_colour(radiance);
}
