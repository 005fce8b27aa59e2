// Droplet of spray as a quad that faces the eye and is stretched along its motion.
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

uniform highp samplerCube sky;

out vec2 in_sprite;  // the sprite ends at a distance of 1
flat out vec3 radiance;
flat out float opacity;
out vec4 on_screen;     // clip coordinates of the pixel
flat out float radius;

const float pi = 3.14159265;
#include "haze.glsl"
#include "clouds.glsl"

void main() {
    const float exposure_s = 1.0 / 40.0;
    const float forward = 0.35;  // fraction of the light that is scattered once
    vec3 from_eye = place.xyz - eye[EYE].xyz;
    float distance_m = length(from_eye);
    vec3 ray = from_eye / distance_m;
    vec3 path = 0.5 * exposure_s * (motion.xyz - ray * dot(motion.xyz, ray));
    float half_path = length(path);
    vec3 along = half_path > 1e-4 ? path / half_path : normalize(cross(ray, vec3(0.31, 0.90, 0.29)));
    vec3 across = cross(ray, along);

    // A sprite is at least a pixel wide and a path long, and as much of the image as the droplet.
    float wide = max(place.w, 0.75 * distance_m * floor_look.z);
    float narrowed = place.w / wide;
    in_sprite = vec2(gl_VertexID & 1, gl_VertexID >> 1) * 2.0 - 1.0;
    vec3 at = from_eye + along * (in_sprite.x * (wide + half_path)) + across * (in_sprite.y * wide);
    opacity = motion.w * narrowed * narrowed * wide / (wide + half_path) * smoothstep(0.3, 1.2, distance_m);
    radius = wide;

    float to_sun = dot(ray, sun.xyz);
    // The sea reflects and scatters some of the skylight upwards.
    sunlit = sunlit_at(place.xz, 0.0);
    vec3 scattered = sunlight() * (forward * haze_phase(to_sun) + (1.0 - forward) / (4.0 * pi)) +
                     sky_irradiance.rgb * (0.55 / pi);
    radiance = through_haze(scattered, from_eye, distance_m);

    on_screen = clip_from_viewer[EYE] * vec4(at + eye[EYE].xyz, 1.0);
    // Depth of the point of a ball that is nearest to the eye, so that the sea does not cut sprites
    // that are in front of it.
    vec4 nearest = clip_from_viewer[EYE] * vec4(at - ray * min(wide, 0.5 * distance_m) + eye[EYE].xyz, 1.0);
    gl_Position = vec4(on_screen.xy, nearest.z / nearest.w * on_screen.w, on_screen.w);
}
