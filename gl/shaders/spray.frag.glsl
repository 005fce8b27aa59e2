// Card of a droplet. The opacity of a ball is (1 - r^2)^2 of that at its middle, a third of it on
// average, and that of a shred is equal on average. With SOFT the card fades where it meets the
// surfaces of a depth texture.
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
flat in vec3 shred;
flat in vec2 to_light;
out vec4 colour;

// Weight of a sample in a mean, equal for all sprites (SprayRenderer::draw()).
uniform highp float sample_weight;

uniform mediump sampler2DArray shreds;

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
    vec3 place = vec3(0.5 + 0.5 * in_sprite * vec2(1.0, shred.z), shred.y);
    float alpha = opacity * mix(inside * inside, 2.0 * texture(shreds, place).r, shred.x);
#ifdef SOFT
    alpha *= in_front_of_scene();
#endif
    vec3 lit = radiance * (1.0 + dot(in_sprite, to_light));
    vec3 shown = output_kind.y > 0.5 ? min(lit, vec3(6e4)) * sample_weight : screen_colour(lit).rgb;
    colour = vec4(shown * alpha, alpha);
}
