// Floor without a water surface in front: beaches and islands from the air, and all of the floor
// from within the water.
#ifdef MULTIVIEW
#extension GL_OVR_multiview2 : require
#endif
precision highp float;
precision highp int;
#include "scene.glsl"
#include "tone.glsl"

in vec4 place;
in float sunlit_vertex;
out vec4 colour;

const float pi = 3.14159265;

#include "lens.glsl"
#include "mirror.glsl"
#include "caustics.glsl"
#include "water_light.glsl"
#include "floor.glsl"
#include "under_water.glsl"
#include "haze.glsl"

void main() {
    sunlit = clamp(sunlit_vertex, 0.0, 1.0);
    vec3 from_eye = leading_ahead(place.xyz - eye[EYE].xyz);
    float distance_m = length(from_eye);
#ifdef SURFACE_DATA
    vec3 facet = cross(dFdx(place.xyz), dFdy(place.xyz));
    colour = vec4(distance_m, facet.xz / (facet.y == 0.0 ? 1e-9 : facet.y), -1.0);
    return;
#endif
    float above = lens_above_water(from_eye);
    vec3 radiance = floor_light(place.xyz, pixel_on_floor(distance_m));
    radiance = above < 0.0 ? through_water(radiance, eye[EYE].xyz, from_eye / distance_m, distance_m)
                           : through_haze(radiance, from_eye, distance_m);
    colour = screen_colour(across_meniscus(radiance, above));
}
