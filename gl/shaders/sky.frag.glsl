// What is behind the sea: the baked sky and the sun's disc, or the water itself where the lens is within it.
#ifdef MULTIVIEW
#extension GL_OVR_multiview2 : require
#endif
precision highp float;
precision highp int;
#include "scene.glsl"
#include "tone.glsl"

in vec3 ray;
out vec4 colour;

const float pi = 3.14159265;

#include "lens.glsl"
#include "mirror.glsl"
#include "caustics.glsl"
#include "water_light.glsl"
#include "under_water.glsl"

void main() {
    vec3 direction = normalize(ray);
    float above = lens_above_water(ray);
    if (above < 0.0) {
        // Upwards there is the surface, but for rays that just miss it.
        vec3 level = normalize(vec3(direction.x, min(direction.y, -0.001), direction.z));
        vec3 water = through_water(vec3(0.0), eye[EYE].xyz, level, 1e4);
        colour = screen_colour(across_meniscus(water, above));
        return;
    }
    if (viewer.x < 0.5) discard;
    // Under the horizon lies the sea; where a host draws none, the horizon goes on.
    vec3 radiance = textureLod(sky, vec3(direction.x, max(direction.y, 0.0), direction.z), 0.0).rgb;
    float off_centre = length(direction - sun.xyz) / sun.w;
    float edge = max(fwidth(off_centre), 0.02);
    float disc = 1.0 - smoothstep(1.0 - edge, 1.0 + edge, off_centre);
    // Darker towards the limb: 1 - 0.6 (1 - cosine), the classic fit for visible light. 0.8 is its mean over the disc.
    float limb = (0.4 + 0.6 * sqrt(max(0.0, 1.0 - off_centre * off_centre))) / 0.8;
    radiance += sun_irradiance.rgb * (disc * limb / (3.14159265 * sun.w * sun.w)) * smoothstep(-0.002, 0.0, direction.y);
    colour = screen_colour(across_meniscus(min(radiance, vec3(6e4)), above));
}
