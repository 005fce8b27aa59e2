// The sky behind the sea: the baked cube, and the sun's disc.
#ifdef MULTIVIEW
#extension GL_OVR_multiview2 : require
#endif
precision highp float;
precision highp int;
#include "scene.glsl"
#include "tone.glsl"

uniform highp samplerCube sky;

in vec3 ray;
out vec4 colour;

void main() {
    vec3 direction = normalize(ray);
    // Under the horizon lies the sea; where a host draws none, the horizon goes on.
    vec3 radiance = textureLod(sky, vec3(direction.x, max(direction.y, 0.0), direction.z), 0.0).rgb;
    float off_centre = length(direction - sun.xyz) / sun.w;
    float edge = max(fwidth(off_centre), 0.02);
    float disc = 1.0 - smoothstep(1.0 - edge, 1.0 + edge, off_centre);
    // Darker towards the limb: 1 - 0.6 (1 - cosine), the classic fit for visible light. 0.8 is its mean over the disc.
    float limb = (0.4 + 0.6 * sqrt(max(0.0, 1.0 - off_centre * off_centre))) / 0.8;
    radiance += sun_irradiance.rgb * (disc * limb / (3.14159265 * sun.w * sun.w)) * smoothstep(-0.002, 0.0, direction.y);
    colour = screen_colour(min(radiance, vec3(6e4)));
}
