// Rock: grey diffuse stone, darker where waves wet it, with pale traces of spray and birds above.
precision highp float;
#include "mesh_light.glsl"
#include "film.glsl"

in vec3 at;
in vec3 facing;
out vec4 colour;

void main() {
    const float pi = 3.14159265;
    vec3 normal = normalize(facing);
    // The strata are inclined.
    float strata = 0.5 + 0.5 * sin(5.0 * (at.y + 0.25 * at.x) + 1.5 * sin(0.9 * at.z + 0.6 * at.x));
    vec3 albedo = mix(vec3(0.13, 0.115, 0.10), vec3(0.22, 0.20, 0.175), strata);
    albedo = mix(albedo, vec3(0.34, 0.33, 0.30), 0.6 * smoothstep(3.0, 5.0, at.y) * smoothstep(0.5, 0.9, normal.y));
    albedo *= mix(0.35, 1.0, smoothstep(0.3, 0.9, at.y + 0.2 * sin(1.7 * at.x) * sin(1.3 * at.z)));
    // The sea below the horizon reflects about 6 % of the sky.
    vec3 irradiance = sun_irradiance.rgb * max(dot(normal, sun.xyz), 0.0) +
                      sky_irradiance.rgb * mix(0.06, 1.0, 0.5 + 0.5 * normal.y);
    colour = weighted_sample(albedo / pi * irradiance, sun_irradiance.w);
}
