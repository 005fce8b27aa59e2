// Droplet of spray as a card that faces the eye and is stretched along its motion.
//
// A droplet is a ball as it leaves the water. Within a quarter of a second the wind tears it: its card
// shows a shred (gl/water/spray_image.hpp). In a gale clumps of fine drops rise then, because
// turbulence carries them. Each stands for more spray than its droplet, even more so far away, where
// fewer leave the crests (sim/spray/crest_spray.cpp). All of this is chosen by eye.
//
// A droplet scatters light as a clump of drops. Light is scattered once, mostly forwards, and with
// the other fraction as often as makes it equal in all directions. Sunlight and skylight are not
// attenuated by other droplets.
#ifdef MULTIVIEW
#extension GL_OVR_multiview2 : require
layout(num_views = 2) in;
#endif
precision highp float;
#include "scene.glsl"

layout(location = 0) in vec4 place;   // xyz: relative to the viewer; w: radius
layout(location = 1) in vec4 motion;  // xyz: velocity; w: opacity at the middle
layout(location = 2) in vec2 origin;  // x: age; y: random number in [0, 1)

uniform highp samplerCube sky;
uniform highp float gale;  // 0 to 1: how much spray there is

out vec2 in_sprite;  // the sprite ends at a distance of 1
flat out vec3 radiance;
flat out float opacity;
out vec4 on_screen;     // clip coordinates of the pixel
flat out float radius;
flat out vec3 shred;    // x: fraction that is torn; y: layer; z: 1 or -1, mirrored
flat out vec2 to_light; // change of the radiance over the card, by its coordinates

const float pi = 3.14159265;
#include "haze.glsl"
#include "clouds.glsl"

void main() {
    const float exposure_s = 1.0 / 40.0;
    const float forward = 0.35;  // fraction of the light that a ball scatters once
    vec3 from_eye = place.xyz - eye[EYE].xyz;
    float distance_m = length(from_eye);
    vec3 ray = from_eye / distance_m;
    float torn = smoothstep(0.0, 0.25, origin.x);
    float mist = torn * smoothstep(0.04, 0.12, place.w);
    vec3 path = 0.5 * exposure_s * (motion.xyz - ray * dot(motion.xyz, ray));
    float half_path = length(path);
    // Wind draws shreds out along the surface, also those that move towards the eye.
    vec3 level = normalize(vec3(-ray.z, 1e-3, ray.x)), streak = mix(path, level * dot(level, path), 0.6 * mist);
    streak += mist * 0.1 * exposure_s * length(motion.xyz) * (dot(level, path) < 0.0 ? -level : level);
    float drawn = length(streak);
    vec3 along = drawn > 1e-4 ? streak / drawn : normalize(cross(ray, vec3(0.31, 0.90, 0.29)));
    vec3 across = cross(ray, along);

    float stands_for = gale * mist * (0.35 + min(distance_m / 130.0, 0.95));
    float ball = place.w * (1.0 + stands_for);
    // A card is at least a pixel wide and a path long, and as much of the image as the droplet.
    float wide = max(ball, 0.75 * distance_m * floor_look.z);
    float narrowed = ball / wide;
    // The wind draws shreds out.
    float drawn_out = mist * wide * length(cross(ray, motion.xyz)) / (6.0 + length(motion.xyz));
    float long_m = wide + half_path + drawn_out;
    in_sprite = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    vec3 at = from_eye + along * (in_sprite.x * long_m) + across * (in_sprite.y * wide);
    at.y += 0.6 * gale * mist * wide;
    float near = mix(smoothstep(0.3, 1.2, distance_m), smoothstep(wide, 3.0 * wide, distance_m), mist);
    opacity = min(motion.w * (1.0 + 1.5 * stands_for), 1.0) * narrowed * narrowed *
              (wide + drawn_out) / long_m * near;
    radius = wide;
    shred = vec3(torn, floor(4.0 * origin.y), fract(8.0 * origin.y) < 0.5 ? 1.0 : -1.0);

    // Light that is scattered once comes from about ahead: through thin shreds from the sky behind them.
    float to_sun = dot(ray, sun.xyz), once = mix(forward, 0.6, mist);
    vec3 ahead = normalize(vec3(ray.x, max(ray.y, 0.1), ray.z));
    // The sea reflects and scatters some of the skylight upwards.
    sunlit = sunlit_at(place.xz, 0.0);
    vec3 skylight = mix(sky_irradiance.rgb * (0.55 / pi), textureLod(sky, ahead, 0.55 * sky_irradiance.w).rgb,
                        once * mist * smoothstep(-0.5, 0.0, ray.y));
    vec3 scattered = sunlight() * (once * haze_phase(to_sun) + (1.0 - once) / (4.0 * pi)) + skylight;
    // Other drops take light from those behind them.
    vec3 light = mix(sun.xyz, vec3(0.0, 1.0, 0.0), 0.5);
    to_light = 0.6 * torn * vec2(dot(along, light), dot(across, light));
    radiance = through_haze(scattered, from_eye, distance_m);

    on_screen = clip_from_viewer[EYE] * vec4(at + eye[EYE].xyz, 1.0);
    // Depth of the point of a ball that is nearest to the eye, so that the sea does not cut sprites
    // that are in front of it.
    vec4 nearest = clip_from_viewer[EYE] * vec4(at - ray * min(wide, 0.5 * distance_m) + eye[EYE].xyz, 1.0);
    gl_Position = vec4(on_screen.xy, nearest.z / nearest.w * on_screen.w, on_screen.w);
}
