// Sprite of a droplet. Its opacity is (1 - r^2)^2 of that at the middle, a third of it on average.
// With SOFT the sprite fades where it meets the surfaces of a depth texture.
#ifdef MULTIVIEW
#extension GL_OVR_multiview2 : require
#endif
precision highp float;
precision highp int;
#include "scene.glsl"
#include "tone.glsl"

in vec2 in_sprite;
flat in vec3 radiance;
flat in float opacity;
in vec4 on_screen;
flat in float radius;
out vec4 colour;

// Weight of a sample in a mean, equal for all sprites (SprayRenderer::draw()).
uniform highp float sample_weight;

#ifdef SOFT
uniform highp sampler2D scene_depth;

// Returns the fraction of a ball of the sprite's radius that is in front of the scene, as a ramp.
float in_front_of_scene() {
    vec2 at = on_screen.xy / on_screen.w;
    float depth = textureLod(scene_depth, 0.5 + 0.5 * at, 0.0).r;
    if (depth >= 1.0) return 1.0;
    highp mat4 m = viewer_from_clip[EYE];
    float ahead = 1.0 / dot(vec4(m[0].w, m[1].w, m[2].w, m[3].w), vec4(at, 2.0 * depth - 1.0, 1.0));
    return clamp(0.5 + (ahead - on_screen.w) / (2.0 * radius), 0.0, 1.0);
}
#endif

void main() {
    float inside = max(1.0 - dot(in_sprite, in_sprite), 0.0);
    float alpha = opacity * inside * inside;
#ifdef SOFT
    alpha *= in_front_of_scene();
#endif
    vec3 shown = output_kind.y > 0.5 ? min(radiance, vec3(6e4)) * sample_weight : screen_colour(radiance).rgb;
    colour = vec4(shown * alpha, alpha);
}
