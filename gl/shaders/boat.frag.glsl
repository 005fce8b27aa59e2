// Boat: diffuse paint, wet at the waterline.
precision highp float;
#include "mesh_light.glsl"
#include "film.glsl"

in vec3 at;
in vec3 facing;
in vec3 paint;
out vec4 colour;

void main() {
    const float pi = 3.14159265;
    vec3 normal = normalize(facing);
    vec3 albedo = paint * mix(0.45, 1.0, smoothstep(0.05, 0.3, at.y));
    // The sea below the horizon reflects about 6 % of the sky.
    vec3 irradiance = sun_irradiance.rgb * max(dot(normal, sun.xyz), 0.0) +
                      sky_irradiance.rgb * mix(0.06, 1.0, 0.5 + 0.5 * normal.y);
    colour = weighted_sample(albedo / pi * irradiance, sun_irradiance.w);
}
