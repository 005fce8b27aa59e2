// Geometry and light of the sea floor: a plane at the sea's depth, or a height field.

// Heights in the world in metres, as half floats. Their precision is best near the
// waterline.
uniform highp sampler2D floor_heights;

#if defined(FLOOR) && SHADING != HEADSET
uniform sampler2D detail;
#endif
#if defined(FLOOR) && defined(SHORE)
#include "shore.glsl"
#endif

bool has_floor_heights() { return floor_place.z > 0.0; }

vec2 floor_uv(vec2 at) { return floor_place.xy + at * floor_place.zw; }

// Returns the height above the still-water level.
float floor_height(vec2 at, float mip) {
    if (!has_floor_heights()) return floor_look.x;
    return textureLod(floor_heights, floor_uv(at), mip).x - viewer.w;
}

vec3 floor_normal(vec2 at, float mip) {
    if (!has_floor_heights()) return vec3(0.0, 1.0, 0.0);
    vec2 texel = exp2(floor(mip + 0.5)) / vec2(textureSize(floor_heights, 0));
    vec2 uv = floor_uv(at);
    vec2 rise = vec2(textureLod(floor_heights, uv + vec2(texel.x, 0.0), mip).x -
                         textureLod(floor_heights, uv - vec2(texel.x, 0.0), mip).x,
                     textureLod(floor_heights, uv + vec2(0.0, texel.y), mip).x -
                         textureLod(floor_heights, uv - vec2(0.0, texel.y), mip).x);
    vec2 slope = 0.5 * rise * floor_place.zw / texel;
    return normalize(vec3(-slope.x, 1.0, -slope.y));
}

// Returns the distance to the floor along a ray that leads down, metres. For a plane it is exact.
// For a height field two iterations follow, which converge where the floor is less steep than the
// ray.
float path_to_floor(vec3 start, vec3 ray) {
    float high = start.y + viewer.z;
    float down = max(-ray.y, 0.02);
    float path = max(high - floor_height(start.xz, 0.0), 0.0) / down;
#if SHADING != HEADSET
    if (has_floor_heights())
        for (int i = 0; i < 2; ++i)
            path = max(high - floor_height(start.xz + ray.xz * min(path, 1e3), 0.0), 0.0) / down;
#endif
    return path;
}

// Returns the caustics on the floor. `at` is where the sun's ray enters flat water.
float caustics_on_floor(vec2 at, float depth, float pixel_m) {
#if SHADING != HEADSET
    if (has_baked_caustics()) {
        float noise = textureLod(detail, noise_of_caustics(at), 5.0).z;
        return caustics_of_copies(at, depth, pixel_m, 32.0 * (noise - 0.5));
    }
#endif
    return caustics_seen(rows_in_pixel(at, pixel_m), depth);
}

// Returns the width of a pixel on the floor at a distance.
float pixel_on_floor(float distance_m) { return floor_look.z * distance_m; }

#if defined(SHORE) && SHADING != HEADSET
// Adds the reflection of the sky in the film of water that runs off wet sand.
vec3 with_film_of_water(vec3 light, vec3 at, vec3 normal, float wet) {
    vec3 to_eye = normalize(eye[EYE].xyz - at);
    float facing = max(dot(normal, to_eye), 0.0);
    if (wet * floor_look.w <= 0.0 || facing <= 0.0) return light;
    vec3 mirrored = reflect(-to_eye, normal);
    vec3 seen = textureLod(sky, vec3(mirrored.x, max(mirrored.y, 0.01), mirrored.z), 0.4 * sky_irradiance.w).rgb;
    return mix(light, seen, 0.6 * wet * floor_look.w * mean_fresnel(facing, 0.15));
}
#endif

// Returns the radiance of the floor for a pixel of width pixel_m. Under water, sunlight is
// attenuated along its refracted path and skylight with depth. Sand has ripples a quarter of a
// metre apart, as swell forms them. Wet sand is darker than dry sand (Lobell and Asner 2002: by
// half).
vec3 floor_light(vec3 at, float pixel_m) {
    float depth = -(at.y + viewer.z);
#if SHADING == HEADSET
    vec3 normal = vec3(0.0, 1.0, 0.0), rippled = normal;
    float coarse = 0.5, middle = 0.5;
#else
    float mip = has_floor_heights() ? log2(max(pixel_m * floor_place.z * float(textureSize(floor_heights, 0).x), 1.0)) : 0.0;
    vec3 normal = floor_normal(at.xz, mip);

    vec2 place_on_sand = at.xz + floor_mesh.zw;  // has a period of 64 m
    float coarse = textureLod(detail, place_on_sand / 16.0, log2(max(pixel_m * 16.0, 1.0))).z;
    float middle = textureLod(detail, place_on_sand.yx / 4.0, log2(max(pixel_m * 64.0, 1.0))).z;
    vec2 across = vec2(230.0, 97.0) / 64.0;  // ripples per metre
    float phase = 2.0 * pi * dot(place_on_sand, across) + 9.0 * coarse + 2.5 * middle;
    float ripples = 0.32 * (1.0 - smoothstep(0.05, 0.14, pixel_m)) * smoothstep(-0.3, 0.5, depth) * floor_look.w;
    vec3 rippled = normalize(normal + vec3(across.x, 0.0, across.y) * (0.256 * ripples * cos(phase)));
#endif

    const vec3 wet_sand = vec3(0.35, 0.31, 0.25);
#ifdef SHORE
    // Sand is wet and dark up to the height that waves reach, and slightly above because sand draws
    // up water.
    float above_reach = -depth - textureLod(shore_reach, shore_uv(at.xz), 0.0).x;
    float wet = 1.0 - smoothstep(0.0, 0.08, above_reach + 0.06 * (middle - 0.5));
#else
    float wet = 1.0 - smoothstep(0.6, 1.4, -depth / floor_look.y + 0.5 * (middle - 0.5));
#endif
    // Wind evens out dry sand. Under water, shells and algae form patches.
    vec3 albedo = wet_sand * mix(1.65, 1.0, wet) * mix(0.87 + 0.16 * coarse + 0.1 * middle, 0.62 + 0.45 * coarse + 0.31 * middle, wet);
    albedo = mix(floor_albedo.rgb, albedo, floor_look.w);

    if (depth <= 0.0) {
        vec3 light = albedo / pi * (sunlight() * max(dot(rippled, sun.xyz), 0.0) +
                                    sky_irradiance.rgb * (0.5 + 0.5 * normal.y));
#if defined(SHORE) && SHADING != HEADSET
        light = with_film_of_water(light, at, normal, wet);
#endif
        return light;
    }
    vec3 k = attenuation_of_water();
    vec3 to_sun = sun_in_water();
    float gathered = caustics_on_floor(at.xz + to_sun.xz / to_sun.y * depth, depth, pixel_m);
    vec3 from_sun = sunlight_below() / to_sun.y * exp(-k * depth / to_sun.y) * max(dot(rippled, to_sun), 0.0) * gathered;
    return albedo / pi * (from_sun + skylight_below() * exp(-k * depth) * (0.5 + 0.5 * normal.y));
}
