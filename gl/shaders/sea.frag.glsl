// Water surface. Steps of main(), in order:
//
//   waves    normal and roughness of the surface in the pixel, or of small water; slopes of dynamic
//            waves
//   mirror   reflection of the sky, weighted by the projected area of the facets; glints of the
//            sun, counted near the eye; with MIRRORS_SCENE also the application's scene
//   water    light from below: absorption and backscattering, light through crests
//   foam     white diffuse light; the cascades' maps give the coverage, a texture gives the
//            structure
//   haze     blends towards the colour of the sky at the horizon
//
// SURFACE_DATA writes values of the surface in place of light (DrawMode::surface_data).
//
// BELOW is set if a floor is visible or the lens is near the surface. The surface is then
// transparent, and pixels whose lens is under water show the surface from below.
#ifdef MULTIVIEW
#extension GL_OVR_multiview2 : require
#endif
precision highp float;
precision highp int;
#include "scene.glsl"
#include "tone.glsl"

in vec4 place;
#ifdef SKIRT
#include "clouds.glsl"
#else
in vec2 rest;
in float sunlit_vertex;
#if SURFACE == OPEN && VERTEX_CASCADES == 0
in vec2 long_slopes;
#endif
#if VERTEX_CASCADES > 0
in vec4 coarsest;
#elif MESH_SLOPES
in vec2 mesh_slopes;
#endif
#endif
out vec4 colour;

const float pi = 3.14159265;

#ifdef SHORE
#include "shore.glsl"
#endif
#include "waves.glsl"
#if SURFACE != OPEN
#include "small_water.glsl"
#include "small_surface.glsl"
#endif
#include "mirror.glsl"
#include "glints.glsl"
#ifdef MIRRORS_SCENE
#include "scene_mirror.glsl"
#endif
#include "water_light.glsl"
#include "water.glsl"
#if SURFACE == OPEN
#include "snapshot_foam.glsl"
#endif
#ifdef DYNAMIC_WAVES
#include "dynamic_waves.glsl"
#endif
#include "foam.glsl"
#include "haze.glsl"
#if BELOW
#include "lens.glsl"
#include "caustics.glsl"
#include "floor.glsl"
#include "floor_through_water.glsl"
#include "under_water.glsl"
#include "surface_from_below.glsl"
#endif
#ifdef EXCLUSIONS
#include "exclusions.glsl"
#endif

#ifdef SKIRT
// Returns the position of a pixel on the skirt, relative to the viewer.
//
// The skirt reaches to infinity. With multisampling, pixels whose centre is outside its triangles
// are shaded too. There the interpolation divisor, and with it `place`, may have the wrong sign.
// The direction of the ray through the pixel is still correct up to its sign, and the ray must
// point ahead. Its intersection with the flat sea is the position; at the horizon it is far away.
vec3 place_on_skirt() {
    vec3 ray = place.xyz - eye[EYE].xyz * place.w;
    vec4 middle = viewer_from_clip[EYE] * vec4(0.0, 0.0, 0.0, 1.0);
    if (dot(ray, middle.xyz / middle.w - eye[EYE].xyz) < 0.0) ray = -ray;
    ray = normalize(ray);
    float height = viewer.z + eye[EYE].y;
    return eye[EYE].xyz + ray * (abs(height) / max(height < 0.0 ? ray.y : -ray.y, 1e-6));
}
#endif

void main() {
#ifdef EXCLUSIONS
    if (is_excluded(place.xyz)) discard;
#endif
#ifdef SKIRT
    vec3 at = place_on_skirt();
    vec2 resting = at.xz;
    sunlit = clamp(sunlit_at(resting, footprint_of(resting).wide_m), 0.0, 1.0);
#else
    // Beyond the edges of triangles, where samples of a pixel may lie, it is extrapolated.
    sunlit = clamp(sunlit_vertex, 0.0, 1.0);
#if VERTEX_CASCADES > 0
    long_wave_normal = normalize(vec3(-coarsest.x, 1.0, -coarsest.y));
#elif SURFACE == OPEN
    long_wave_normal = normalize(vec3(-long_slopes.x, 1.0, -long_slopes.y));
#endif
    vec3 at = place.xyz;
    vec2 resting = rest;
#endif
    vec3 from_eye = at - eye[EYE].xyz;
    float distance_m = length(from_eye);
    vec3 to_eye = -from_eye / distance_m;
    float height = at.y + viewer.z;

#ifdef SHORE
    sample_shore(at.xz);
#endif
    Waves surface = waves_at(resting, distance_m);
#ifdef COUNTED_GLINTS
    Footprint pixel = footprint_of(resting);  // before branches, which leave derivatives undefined
#endif
#ifdef DYNAMIC_WAVES
    vec4 added = dynamic_waves(at.xz, footprint_of(resting).wide_m);  // `waves` is a uniform
    surface.slopes -= added.yz;
    surface.crests = max(surface.crests, added.w);
#endif
    vec3 normal = normalize(vec3(surface.slopes.x, 1.0, surface.slopes.y));
#if !defined(SKIRT) && SHADING != HEADSET
#if MESH_SLOPES
    vec3 facet = normalize(vec3(-mesh_slopes.x, 1.0, -mesh_slopes.y));
#else
    vec3 facet = normalize(cross(dFdx(at), dFdy(at)));
    if (facet.y < 0.0) facet = -facet;
#endif
    normal = seen_normal(normal, facet, to_eye, surface.alpha2, distance_m);
#endif

#if BELOW
    // From below the relief of foam is hidden, so the foam is not offset.
    float above_lens = lens_above_water(from_eye);
    Foam foam = foam_at(resting, distance_m, surface, above_lens < 0.0 ? vec3(0.0, 1.0, 0.0) : to_eye);
#else
    Foam foam = foam_at(resting, distance_m, surface, to_eye);
#endif
#ifdef SURFACE_DATA
    colour = vec4(distance_m, surface.slopes, foam.cover);
    return;
#endif
#if BELOW
    if (above_lens < 0.0) {
        vec3 below = surface_from_below(at, normal, -leading_ahead(from_eye) / distance_m, surface.alpha2, foam, distance_m);
        colour = screen_colour(across_meniscus(below, above_lens));
        return;
    }
    vec3 water_light = light_from_below(at, normal, to_eye, distance_m, surface.alpha2);
#else
    vec3 water_light = upwelling(normal, to_eye);
#endif

    float mirrors = mean_fresnel(clamp(dot(normal, to_eye), 0.0, 1.0), sqrt(0.5 * surface.alpha2));
    float lip = smoothstep(max(foam_kind.x - 1.5, 0.8), max(foam_kind.x - 0.2, 1.8), surface.compression) *
                smoothstep(0.05, 0.35, height / waves.x);
    water_light += through_crests(normal, to_eye, height, lip);
    vec3 mirrored = mirrored_light(normal, to_eye, surface.alpha2, water_light);
#ifdef MIRRORS_SCENE
    mirrored = with_mirrored_scene(mirrored, at, normal, to_eye, surface.alpha2, water_light);
#endif
#ifdef COUNTED_GLINTS
    float sun_glint = sparkling_glint(resting, pixel.dx, pixel.dy, normal, to_eye, surface.alpha2, surface.ripples);
#else
    float sun_glint = glint(normal, to_eye, surface.alpha2);
#endif
    vec3 radiance = mix(water_light, mirrored, mirrors) +
                    sunlight() * sun_glint;
    radiance = with_foam(radiance, foam, normal, to_eye, mirrors);
#if BELOW
    radiance = soft_shore(radiance, at, distance_m, height, foam.cover);
    colour = screen_colour(across_meniscus(through_haze(radiance, from_eye, distance_m), above_lens));
#else
    colour = screen_colour(through_haze(radiance, from_eye, distance_m));
#endif
}
